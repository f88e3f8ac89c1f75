# The tires of studies/tires as a C++ source, for `latsch new`: the files stay the only copy.
function(latsch_embed_tires program)
  file(GLOB tires CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/studies/tires/*.toml)
  list(FILTER tires EXCLUDE REGEX "comparison_")
  set(entries "")
  foreach(tire ${tires})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${tire})
    get_filename_component(file ${tire} NAME)
    string(REGEX REPLACE "\\.toml$" "" name ${file})
    file(READ ${tire} text)
    string(APPEND entries "    {\"${name}\", R\"toml(${text})toml\"},\n")
  endforeach()
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/generated/tire_templates.cpp @ONLY CONTENT
"#include \"cli/templates/study_template.h\"

const std::vector<latsch::cli::TireTemplate>& latsch::cli::tire_templates() {
  static const std::vector<TireTemplate> tires = {
@entries@  };
  return tires;
}
")
  target_sources(${program} PRIVATE ${CMAKE_BINARY_DIR}/generated/tire_templates.cpp)
endfunction()

# docs/study_reference.md, for `latsch help study`.
function(latsch_embed_study_reference program)
  set(page ${CMAKE_SOURCE_DIR}/docs/study_reference.md)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${page})
  file(READ ${page} text)
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/generated/study_reference.cpp @ONLY CONTENT
"#include \"cli/templates/study_reference.h\"

std::string_view latsch::cli::study_reference() { return R\"page(@text@)page\"; }
")
  target_sources(${program} PRIVATE ${CMAKE_BINARY_DIR}/generated/study_reference.cpp)
endfunction()
