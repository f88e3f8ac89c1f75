// SPDX-License-Identifier: Apache-2.0
#include "studio/studio.h"

#include <charconv>
#include <map>

#include "base/error.h"
#include "studio/shelf/study_file.h"
#include "studio/views/json_values.h"
#include "studio/views/views.h"

namespace latsch::studio {
namespace {

// largest number of trials in one event; if there are more, the page requests its range of trials
// again
constexpr long kMostInOneEvent = 200;

/// The query parameters of a request.
class Query {
 public:
  explicit Query(const Request& request) : request_(request) {}

  std::string text(const std::string& key, const std::string& fallback = "") const {
    const auto found = request_.query.find(key);
    return found == request_.query.end() ? fallback : found->second;
  }
  /// Returns the parameter as a whole number, or `fallback` if it is absent. Throws InputError if
  /// it is no whole number of at least `least`.
  long number(const std::string& key, long fallback, long least) const {
    const std::string value = text(key);
    if (value.empty()) return fallback;
    long number = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    if (error != std::errc{} || end != value.data() + value.size() || number < least)
      throw InputError(key + " is \"" + value + "\", expected a whole number of at least " +
                       std::to_string(least));
    return number;
  }
  /// Returns the parameter, which must be `first` or `second`; `first` if it is absent. Throws
  /// InputError for another value.
  std::string either(const std::string& key, const char* first, const char* second) const {
    const std::string value = text(key, first);
    if (value != first && value != second)
      throw InputError(key + " is \"" + value + "\", expected \"" + first + "\" or \"" + second +
                       "\"");
    return value;
  }

 private:
  const Request& request_;
};

class NotThere : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Returns a text from the JSON body of a POST. Throws InputError if the body lacks it.
std::string text_in(const Json& body, const char* key) {
  const auto found = body.find(key);
  if (found == body.end() || !found->is_string())
    throw InputError(std::string(key) + " is missing in the request, expected a text");
  return found->get<std::string>();
}

/// Returns a whole number from the JSON body of a POST; 0 if the body lacks it.
long whole_number_in(const Json& body, const char* key, long least, long most) {
  const auto found = body.find(key);
  if (found == body.end()) return 0;
  if (!found->is_number_integer() || *found < least || *found > most)
    throw InputError(std::string(key) + " is " + found->dump() + ", expected a whole number, " +
                     std::to_string(least) + " to " + std::to_string(most));
  return found->get<long>();
}

/// Returns a flag from the JSON body of a POST; false if the body lacks it.
bool flag_in(const Json& body, const char* key) {
  const auto found = body.find(key);
  if (found == body.end()) return false;
  if (!found->is_boolean())
    throw InputError(std::string(key) + " is " + found->dump() + ", expected true or false");
  return found->get<bool>();
}

std::vector<Edit> edits_in(const Json& body) {
  const auto list = body.find("edits");
  if (list == body.end() || !list->is_array())
    throw InputError("edits is missing in the request, expected a list");
  std::vector<Edit> edits;
  for (const Json& one : *list) {
    if (!one.is_object() || !one.contains("table") || !one["table"].is_array())
      throw InputError("an edit has no table, expected a list of names");
    Edit edit{{}, text_in(one, "key"), {}};
    for (const Json& name : one["table"]) {
      if (!name.is_string()) throw InputError("a table's name is not a text");
      edit.table.push_back(name.get<std::string>());
    }
    const Json value = one.value("value", Json(nullptr));
    if (value.is_string()) {
      edit.value = value.get<std::string>();
    } else if (value.is_boolean()) {
      edit.value = value.get<bool>();
    } else if (value.is_number()) {
      edit.value = value.get<double>();
    } else if (!value.is_null()) {
      throw InputError(edit.key + " is a list or a table, expected a text, a number or a flag");
    }
    edits.push_back(std::move(edit));
  }
  return edits;
}

Json json_of(const Checked& checked) {
  Json view{{"ok", checked.ok}, {"messages", Json::array()}, {"understood", checked.understood}};
  for (const Message& message : checked.messages)
    view["messages"].push_back({{"text", message.text},
                                {"line", message.line > 0 ? Json(message.line) : Json(nullptr)},
                                {"is_wrong", message.is_wrong}});
  return view;
}

Json json_of(const StudyText& text) { return {{"text", text.text}, {"version", text.version}}; }

}  // namespace

class Studio::Impl {
 public:
  Impl(const StudioOptions& options, const experiment::Language& language, Publish publish)
      : options_(options),
        language_(language),
        publish_(std::move(publish)),
        runs_(options.program),
        shelf_(options.root, language, [this](const auto& id, const auto& changes) {
          tell(id, changes);
        }) {}

  Response answer(const Request& request) {
    try {
      if (request.path == "/api/scene") {
        const Query query(request);
        return {200,
                "application/octet-stream",
                scene_view(*study(query.text("study")), query.text("trial"))};
      }
      const Json view = request.method == "POST" ? change(request) : look(request);
      return {200, "application/json", view.dump(-1, ' ', false, Json::error_handler_t::replace)};
    } catch (const NotThere& error) {
      return error_response(404, error.what(), "Load the page again: the folder may have changed");
    } catch (const ChangedMeanwhile& error) {
      return error_response(409, error.what(), "Load the file again");
    } catch (const InputError& error) {
      return error_response(400, error.what(), "");
    } catch (const Json::parse_error& error) {
      return error_response(400, std::string("the request is not valid JSON: ") + error.what(), "");
    } catch (const Json::exception& error) {
      return error_response(400, std::string("the request cannot be read: ") + error.what(), "");
    } catch (const JournalError& error) {
      return error_response(
          422, error.what(), "latsch doctor JOURNAL says what is damaged and saves the rest");
    }
  }

 private:
  std::shared_ptr<ShelvedStudy> study(const std::string& id) {
    if (auto found = shelf_.open(id)) return found;
    throw NotThere("there is no study " + (id.empty() ? "without a name" : "\"" + id + "\"") +
                   " in " + shelf_.folder().string());
  }

  Json look(const Request& request) {
    const Query query(request);
    if (request.path == "/api/home") return home_view(shelf_, options_.version, options_.has_page);
    if (request.path == "/api/keys") return keys_view(language_);
    using View = std::function<Json(ShelvedStudy&)>;
    const std::string weights = query.text("weights"), trial = query.text("trial");
    const std::map<std::string, View> views{
        {"/api/study", [&](auto& s) { return study_view(s, runs_); }},
        {"/api/convergence",
         [&](auto& s) {
           const TrialRange stretch{query.number("from", 1, 1),
                                    query.number("to", 0, 0),
                                    query.number("most", 4000, kFewestPoints)};
           return convergence_view(s, stretch, weights);
         }},
        {"/api/trials",
         [&](auto& s) {
           const TrialsPage page{query.number("from", 1, 1),
                                 query.number("count", 50, 0),
                                 query.either("order", "trial", "target") == "target"};
           return trials_view(s, page, weights);
         }},
        {"/api/trial", [&](auto& s) { return trial_view(s, query.number("trial", 0, 1)); }},
        {"/api/comparison", [&](auto& s) { return comparison_view(s, trial); }},
        {"/api/limits", [&](auto& s) { return limits_view(s, trial); }},
        {"/api/target", [&](auto& s) { return target_view(s, weights); }},
        {"/api/kpis", [&](auto& s) { return kpi_view(s, weights); }},
        {"/api/identifiability", [&](auto& s) { return identifiability_view(s); }},
        {"/api/model", [&](auto& s) { return model_view(s); }},
        {"/api/section", [&](auto& s) { return section_view(s, trial); }},
        {"/api/file", [&](auto& s) { return json_of(read_study_text(s.file())); }},
        {"/api/compare", [&](auto& s) { return comparing_view(s, *study(query.text("other"))); }}};
    const auto view = views.find(request.path);
    if (view == views.end()) throw NotThere("there is nothing at " + request.path);
    return view->second(*study(query.text("study")));
  }

  Json change(const Request& request) {
    const Json body = Json::parse(request.body);
    if (!body.is_object()) throw InputError("the request is not a JSON object");
    const auto shelved = study(text_in(body, "study"));
    if (request.path == "/api/check")
      return json_of(check_study_text(shelved->file(), text_in(body, "text"), language_));
    if (request.path == "/api/save") return save(*shelved, body, text_in(body, "text"));
    if (request.path == "/api/edit") {
      const std::string before = read_study_text(shelved->file()).text;
      std::string text = before;
      for (const Edit& edit : edits_in(body))
        text = edited(text, shelved->file().filename().string(), edit);
      refuse_wrong(*shelved, before, text);
      return save(*shelved, body, text);
    }
    if (request.path == "/api/run") return run(*shelved, body);
    if (request.path == "/api/stop") {
      runs_.stop(*shelved);
      shelf_.look_again();
      return {{"stopping", true}};
    }
    throw NotThere("there is nothing to change at " + request.path);
  }

  /// Throws if `latsch check` refuses the edited text. If the file was wrong before, the edit is
  /// accepted, because it may be part of the correction.
  void refuse_wrong(const ShelvedStudy& shelved,
                    const std::string& before,
                    const std::string& text) const {
    const Checked now = check_study_text(shelved.file(), text, language_);
    if (now.ok || !check_study_text(shelved.file(), before, language_).ok) return;
    for (const Message& message : now.messages)
      if (message.is_wrong) throw InputError("is not changed: " + message.text);
    throw InputError("is not changed: latsch check reports errors in the new text");
  }

  Json save(const ShelvedStudy& shelved, const Json& body, const std::string& text) {
    const std::string version = write_study_text(shelved.file(), text_in(body, "version"), text);
    shelf_.look_again();
    return json_of(StudyText{text, version});
  }

  Json run(const ShelvedStudy& shelved, const Json& body) {
    const std::string name = text_in(body, "verb");
    const auto verb = run_verb(name);
    if (!verb) throw InputError("verb is \"" + name + "\", expected run, resume, doe or identify");
    constexpr int kMostWorkers = 1024;
    const long workers = whole_number_in(body, "workers", 0, kMostWorkers);
    runs_.start(shelved, {*verb, static_cast<int>(workers), flag_in(body, "anew")});
    shelf_.look_again();
    return {{"started", true}};
  }

  /// Publishes the changes of a study to the clients; the watching thread calls this function.
  void tell(const std::string& id, const ShelvedStudy::Changes& changes) {
    if (changes.of_study || changes.of_state || id.empty()) publish_("", "home", "{}");
    if (id.empty()) return;
    const auto shelved = shelf_.find(id);
    if (!shelved) return;
    if (changes.of_trials) {
      const Json event = trials_event(*shelved);
      if (!event.is_null()) publish_(id, "trials", event.dump());
    }
    if (changes.of_state || changes.of_study) {
      publish_(
          id,
          "run",
          shelved
              ->look([&](const auto& sight) {
                return Json{{"study", id}, {"state", name(sight.state)}, {"message", sight.error}};
              })
              .dump(-1, ' ', false, Json::error_handler_t::replace));
    }
  }

  /// Returns an event with the trials of the study that came since the last event; null if the
  /// study can no longer be read.
  Json trials_event(const ShelvedStudy& shelved) {
    return shelved.look([&](const auto& sight) -> Json {
      if (!sight.table) return nullptr;
      const TrialTable& table = *sight.table;
      Told& told = told_[shelved.id()];
      const auto count = static_cast<long>(table.rows().size());
      if (told.edition != table.edition() || told.rows > count) told = {0, table.edition()};
      Json rows = Json::array();
      const auto weighting = table.target().weighting(table.target().weights());
      const auto best = table.best();
      const bool is_many = count - told.rows > kMostInOneEvent;
      for (long k = told.rows; k < count && !is_many; ++k) {
        const auto& parts = table.rows()[static_cast<std::size_t>(k)].parts;
        rows.push_back({{"trial", k + 1},
                        {"target", parts ? finite(weighting.target(*parts)) : Json(nullptr)}});
      }
      told.rows = count;
      return Json{{"study", shelved.id()},
                  {"total", count},
                  {"failed", table.failed()},
                  {"best",
                   best ? Json{{"trial", *best + 1},
                               {"target", finite(weighting.target(*table.rows()[*best].parts))}}
                        : Json(nullptr)},
                  {"is_many", is_many},
                  {"rows", rows}};
    });
  }

  struct Told {
    long rows = 0;
    int edition = 0;
  };

  StudioOptions options_;
  const experiment::Language& language_;
  Publish publish_;
  StudyRuns runs_;
  // state of each study that the clients know; used by the watching thread only
  std::map<std::string, Told> told_;
  Shelf shelf_;  // declared last, so that its thread ends before the members that the thread uses
};

Studio::Studio(const StudioOptions& options, const experiment::Language& language, Publish publish)
    : impl_(std::make_unique<Impl>(options, language, std::move(publish))) {}
Studio::~Studio() = default;

Response Studio::answer(const Request& request) { return impl_->answer(request); }

}  // namespace latsch::studio
