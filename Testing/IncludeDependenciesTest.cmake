# Tests IncludeDependencies.cmake on small generated trees: a tree that follows the rules must pass,
# and each single violation must fail with its file, line and reason.
#
#   cmake -D WORK=<scratch folder> -P IncludeDependenciesTest.cmake
cmake_minimum_required(VERSION 3.25)

# A tree that follows the rules; Haptics represents a module omitted by the preset.
function(write_sound_tree)
  file(REMOVE_RECURSE ${WORK})
  file(WRITE ${WORK}/declared.cmake
    "set(PETROUS_MODULES \"Core;Volume;Imaging;Presenters\")\n"
    "set(PETROUS_DEPENDS_Core \"\")\n"
    "set(PETROUS_DEPENDS_Volume \"Core\")\n"
    "set(PETROUS_DEPENDS_Imaging \"Core;Volume\")\n"
    "set(PETROUS_DEPENDS_Presenters \"Core\")\n")
  file(WRITE ${WORK}/Modules/Core/include/petrous/Core/Grid.h "#include <vector>\n")
  file(WRITE ${WORK}/Modules/Volume/src/Volume.cpp
    "// array[1]; \"quoted\"\n#include \"petrous/Core/Grid.h\"\n#include \"petrous/Volume/Volume.h\"\n")
  file(WRITE ${WORK}/Modules/Imaging/src/Reader.cpp
    "#include <itkImage.h>\n#include <gdcmReader.h>\n#include \"petrous/Volume/Volume.h\"\n")
  file(WRITE ${WORK}/Modules/Haptics/src/Shell.cpp "#include \"petrous/Rendering/Picture.h\"\n")
  file(WRITE ${WORK}/Application/Cli/main.cpp
    "#include <QApplication>\n#include \"petrous/Imaging/Reader.h\"\n")
endfunction()

function(run_script)
  execute_process(
    COMMAND ${CMAKE_COMMAND} -D TREE=${WORK} -D DECLARED=${WORK}/declared.cmake
      -P ${CMAKE_CURRENT_LIST_DIR}/IncludeDependencies.cmake
    RESULT_VARIABLE code OUTPUT_VARIABLE out ERROR_VARIABLE out)
  set(code "${code}" PARENT_SCOPE)
  set(out "${out}" PARENT_SCOPE)
endfunction()

# The valid tree with one file changed must be rejected with `expected`.
function(expect_failure expected file content)
  write_sound_tree()
  file(WRITE ${WORK}/${file} "${content}")
  run_script()
  string(FIND "${out}" "${expected}" at)
  if(code EQUAL 0 OR at EQUAL -1)
    message(SEND_ERROR "expected a failure that says\n  ${expected}\nbut got (exit ${code})\n${out}")
  endif()
endfunction()

write_sound_tree()
run_script()
if(NOT code EQUAL 0)
  message(SEND_ERROR "a tree that keeps the rules was refused:\n${out}")
endif()

expect_failure(
  "Modules/Imaging/Testing/ReaderTest.cpp:3: includes petrous/Scene/Case.h, but Modules/Imaging/CMakeLists.txt does not declare 'DEPENDS Scene'"
  Modules/Imaging/Testing/ReaderTest.cpp
  "#include <gtest/gtest.h>\n\n#  include \"petrous/Scene/Case.h\"\n")
expect_failure(
  "Modules/Core/src/Grid.cpp:2: includes petrous/Volume/Volume.h, but Modules/Core/CMakeLists.txt does not declare 'DEPENDS Volume'"
  Modules/Core/src/Grid.cpp
  "int table[2] = {0, 1}; // [;\n#include \"petrous/Volume/Volume.h\"\n")
expect_failure(
  "Modules/Imaging/include/petrous/Imaging/Reader.h:1: includes itkImage.h, but headers of ITK belong in .cpp files only"
  Modules/Imaging/include/petrous/Imaging/Reader.h "#include <itkImage.h>\n")
expect_failure(
  "Modules/Imaging/include/petrous/Imaging/Scan.h:1: includes gdcmReader.h, but headers of GDCM belong in .cpp files only"
  Modules/Imaging/include/petrous/Imaging/Scan.h "#include \"gdcmReader.h\"\n")
foreach(header vtkImageData.h itkImage.h gdcmTag.h QString QtCore/QObject QVTKOpenGLNativeWidget.h)
  expect_failure("Modules/Volume/src/Slice.cpp:1: includes ${header}, but module Volume must not"
    Modules/Volume/src/Slice.cpp "#include <${header}>\n")
endforeach()
expect_failure(
  "Application/Presenters/CasePresenter.h:1: includes QString, but module Presenters must not include headers of Qt"
  Application/Presenters/CasePresenter.h "#include <QString>\n")
expect_failure("Modules/Core/CMakeLists.txt: Core must not depend on Volume"
  declared.cmake "set(PETROUS_MODULES \"Core\")\nset(PETROUS_DEPENDS_Core \"Volume\")\n")
expect_failure("Modules/Volume/CMakeLists.txt: Volume must not depend on Imaging (allowed: Core)"
  declared.cmake
  "set(PETROUS_MODULES \"Volume\")\nset(PETROUS_DEPENDS_Volume \"Core;Imaging\")\n")
expect_failure("Modules/Extra/CMakeLists.txt: module Extra has no row"
  declared.cmake "set(PETROUS_MODULES \"Extra\")\nset(PETROUS_DEPENDS_Extra \"\")\n")

file(REMOVE_RECURSE ${WORK})
