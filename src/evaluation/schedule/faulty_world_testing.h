// SPDX-License-Identifier: Apache-2.0
// Test support: simulated workers, messages and a store, on a virtual clock, in which everything
// goes wrong: points hang or fail, workers die or stall, messages are late, arrive in another order
// or arrive twice, the store refuses to store, and the master dies. All faults are a function of
// the seed.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstring>
#include <exception>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/random.h"
#include "evaluation/executors/executor.h"
#include "evaluation/journal/trial_store.h"

namespace latsch {

/// Thrown when the master dies. Everything that is not in the store is lost.
struct MasterDied : std::exception {};

/// Shares of points, starts, trials, messages or calls that suffer each fault.
struct Faults {
  double failure = 0.0;   // share of the points that fail, in every simulated run
  double hang = 0.0;      // share of the points that hang: every attempt overruns the timeout
  double timeout = 20.0;  // s; longer than a stalled trial unless a test sets it shorter
  int retries = 0;        // number of repeats of failed trials
  /// Share of starts in which the worker dies, limited to the number of restarts that the
  /// dispatcher allows.
  double death = 0.0;
  double refusal = 0.0;  // share of starts in which the worker is lost before it begins
  double stall = 0.0;    // share of trials that take kStall times as long
  double late = 0.0;
  double twice = 0.0;
  double store = 0.0;
  double master = 0.0;  // share of calls in which the master dies while it listens
};

/// Stores the acknowledged trials, and counts events that must never happen.
class FaultyStore : public TrialStore {
 public:
  FaultyStore(double refused, std::uint64_t seed) : refused_(refused), random_(seed, 1) {}

  void append(std::span<const Trial> trials) override {
    if (random_.uniform() < refused_) throw JournalError("the disk is full");
    for (const Trial& trial : trials) {
      repeated_ += !outcomes_.emplace(trial.point.bits(), trial.outcome).second;
      trials_.push_back(trial);
    }
  }
  void for_each(const std::function<void(const Trial&)>& visit) const override {
    for (const Trial& trial : trials_) visit(trial);
  }

  bool has(const DesignPoint& point) const { return outcomes_.contains(point.bits()); }
  long repeated() const { return repeated_; }
  long size() const { return std::ssize(trials_); }

 private:
  double refused_;
  RandomStream random_;
  std::vector<Trial> trials_;
  std::map<std::string, Outcome> outcomes_;
  long repeated_ = 0;
};

class FaultyWorld : public Executor {
 public:
  FaultyWorld(Evaluator evaluator,
              int workers,
              const Faults& faults,
              const FaultyStore& store,
              std::uint64_t seed)
      : evaluator_(std::move(evaluator)),
        faults_(faults),
        store_(store),
        random_(seed, 2),
        busy_(workers, false) {}

  int workers() const override { return static_cast<int>(busy_.size()); }
  int idle() const override {
    return static_cast<int>(std::count(busy_.begin(), busy_.end(), false));
  }

  void start(const DesignPoint& point) override {
    assert(idle() > 0);
    started_again_ += store_.has(point);
    const int worker =
        static_cast<int>(std::find(busy_.begin(), busy_.end(), false) - busy_.begin());
    busy_[worker] = true;
    if (faults_.refusal > 0.0 && happens(faults_.refusal)) {
      messages_.push_back({now_ + random_.uniform(), worker, Trial{point, not_begun()}});
      return;
    }
    double time = 0.05 + 0.1 * random_.uniform();
    if (happens(faults_.stall)) time *= kStall;
    if (is_among(point, faults_.hang, 4)) time = 1e9;
    const bool expires = time > faults_.timeout;
    time = std::min(time, faults_.timeout);
    // A worker dies only as often as the dispatcher allows; one death more would count as a fault
    // of the point.
    const int starts = ++starts_[point.bits()];
    most_starts_ = std::max(most_starts_, starts);
    const bool dies = happens(faults_.death) && starts < faults_.retries + 2;
    if (dies) time *= random_.uniform();
    double arrival = now_ + time;
    if (happens(faults_.late)) arrival += 0.3 * random_.uniform();
    Trial trial{point, dies ? lost() : expires ? expired() : outcome(point)};
    trial.outcome.wall_time = time;
    // The death of a worker is noticed directly, not reported by a message, so it cannot be
    // reported twice.
    if (!dies && happens(faults_.twice)) {
      messages_.push_back({arrival + 0.5 * random_.uniform(), kNobody, trial});
    }
    messages_.push_back({arrival, worker, std::move(trial)});
  }

  std::vector<Trial> wait(double patience) override {
    if (now_ > kTooLong) throw std::runtime_error("the search does not come to its end");
    const auto by_time = [](const Message& a, const Message& b) { return a.arrival < b.arrival; };
    const auto next = std::min_element(messages_.begin(), messages_.end(), by_time);
    if (next == messages_.end() || next->arrival > now_ + patience) {
      now_ += patience;
      return {};
    }
    if (happens(faults_.master)) throw MasterDied();
    now_ = std::max(now_, next->arrival);
    std::vector<Trial> arrived{next->trial};
    if (next->worker != kNobody) busy_[next->worker] = false;
    messages_.erase(next);
    return arrived;
  }

  /// Drops the point from its worker. Messages that were sent before still arrive.
  void withdraw(const DesignPoint& point) override {
    for (Message& message : messages_) {
      if (message.trial.point == point) forget(message);
    }
  }
  void abandon() override {
    for (Message& message : messages_) forget(message);
  }
  double now() const override { return now_; }

  /// Returns the number of trials that were started although the store had them.
  long started_again() const { return started_again_; }

  /// Returns the number of starts of the point that was started most often.
  int most_starts() const { return most_starts_; }

  static constexpr double kStall = 50.0;
  static constexpr double kTooLong = 1e5;  // s, far longer than the ten seconds of a search

 private:
  static constexpr int kNobody = -1;
  struct Message {
    double arrival;
    int worker;  // worker that is idle once this message has arrived
    Trial trial;
  };

  bool happens(double share) { return random_.uniform() < share; }

  void forget(Message& message) {
    if (message.worker != kNobody) busy_[message.worker] = false;
    message.worker = kNobody;
  }

  /// Decides whether a point belongs to the given share of all points. The decision is a hash of
  /// the point's first value, so it is the same in every repetition.
  static bool is_among(const DesignPoint& point, double share, std::uint64_t lot) {
    std::uint64_t key = 0;
    std::memcpy(&key, point.values.data(), sizeof key);
    return RandomStream(lot, key).uniform() < share;
  }

  static Outcome lost() { return {.result = Failure{"the worker died", Cause::transient}}; }
  static Outcome not_begun() { return {.result = Failure{"no worker", Cause::not_begun}}; }
  static Outcome expired() { return {.result = Failure{"took too long", Cause::timeout}}; }
  Outcome outcome(const DesignPoint& point) const {
    if (is_among(point, faults_.failure, 3)) return {.result = Failure{"no equilibrium"}};
    return evaluate(evaluator_, point);
  }

  Evaluator evaluator_;
  Faults faults_;
  const FaultyStore& store_;
  RandomStream random_;
  std::vector<bool> busy_;
  std::vector<Message> messages_;
  std::map<std::string, int> starts_;  // starts of each point, keyed by its bits
  int most_starts_ = 0;
  double now_ = 0.0;
  long started_again_ = 0;
};

}  // namespace latsch
