# petrous_embed_resource(<target> <name> <file>)
# Generates <name>.h with `constexpr std::string_view k<name>` from a text file under Resources, so
# that the program does not depend on where it is installed.
function(petrous_embed_resource target name file)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  file(READ ${file} PETROUS_RESOURCE_TEXT)
  set(PETROUS_RESOURCE_NAME ${name})
  configure_file(${CMAKE_SOURCE_DIR}/Packaging/cmake/Resource.h.in
    ${CMAKE_CURRENT_BINARY_DIR}/resources/${name}.h @ONLY)
  target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/resources)
endfunction()
