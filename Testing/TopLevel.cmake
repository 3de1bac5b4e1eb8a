# Checks that the top level of the tree contains exactly what the layout lists.
#
#   cmake -D TREE=<source tree> -P TopLevel.cmake
cmake_minimum_required(VERSION 3.25)

set(required
  .ci .clang-format .clang-tidy .gitignore Application CHANGELOG.md CMakeLists.txt
  CMakePresets.json Documentation LICENSE Modules Packaging README.md Resources Testing)
# Not part of the project, but expected in a checkout.
set(tolerated .cache .git build CMakeUserPresets.json)

file(GLOB entries RELATIVE ${TREE} ${TREE}/* ${TREE}/.*)
list(REMOVE_ITEM entries . ..)
foreach(entry IN LISTS entries)
  if(NOT entry IN_LIST required AND NOT entry IN_LIST tolerated)
    message(SEND_ERROR "${entry}: the top level has no place for it")
  endif()
endforeach()
foreach(entry IN LISTS required)
  if(NOT entry IN_LIST entries)
    message(SEND_ERROR "${entry}: missing from the top level")
  endif()
endforeach()
