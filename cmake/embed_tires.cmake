# Embeds the tires of studies/tires as a C++ source for `latsch new`, so that the files stay the
# only copy.
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

# Embeds a text file as a C++ source. `function`, declared in `header`, returns the text.
function(latsch_embed_text program file header function)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${file})
  file(READ ${CMAKE_SOURCE_DIR}/${file} text)
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/generated/${function}.cpp @ONLY CONTENT
"#include \"cli/templates/@header@\"

std::string_view latsch::cli::@function@() { return R\"page(@text@)page\"; }
")
  target_sources(${program} PRIVATE ${CMAKE_BINARY_DIR}/generated/${function}.cpp)
endfunction()
