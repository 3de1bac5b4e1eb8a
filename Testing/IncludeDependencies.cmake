# Checks every #include against its module's declared dependencies and the module table.
#
#   cmake -D TREE=<source tree> -D DECLARED=<file> -P IncludeDependencies.cmake
#
# DECLARED sets PETROUS_MODULES and PETROUS_DEPENDS_<Name>, the DEPENDS of each petrous_add_module.
# Modules omitted by the preset are not declared and not read. Each violation is one line: file,
# line number, what is missing or forbidden.
cmake_minimum_required(VERSION 3.25)

# Permitted dependencies of modules, strictly downwards: a row names no module above it.
set(allowed_Core)
set(allowed_Volume Core)
set(allowed_Appearance Core Volume)
set(allowed_Imaging Core Volume)
set(allowed_Phantom Core Volume Imaging)
set(allowed_Registration Core Volume)
set(allowed_Segmentation Core Volume Appearance)
set(allowed_Haptics Core Volume)
set(allowed_Devices Core Volume Haptics)
set(allowed_Dissection Core Volume)
set(allowed_Scene Core Volume Appearance Dissection)
set(allowed_Session Core Volume Haptics Dissection Scene)
set(allowed_Library Core Volume Appearance Dissection Scene Imaging)
set(allowed_Video Core)
set(allowed_Sound Core)
set(allowed_Network Core Volume Scene Imaging Library)
set(allowed_Rendering Core Volume Appearance)
set(allowed_Interaction
  Core Volume Appearance Haptics Dissection Session Scene Rendering)
# The application's view models: built like a module, and independent of Qt (no toolkit below).
set(allowed_Presenters
  Core Volume Appearance Imaging Phantom Registration Segmentation Haptics Devices Dissection Session Scene
  Library Video Sound Network Rendering Interaction)
set(folder_Presenters Application/Presenters)
set(known_modules
  Core Volume Appearance Imaging Phantom Registration Segmentation Haptics Devices Dissection Session Scene
  Library Video Sound Network Rendering Interaction Presenters)

# The toolkits whose headers a module may include; modules not listed here include none. Qt is
# reserved for the application.
set(toolkits_Imaging ITK GDCM DCMTK)
set(toolkits_Imaging_Testing VTK) # writes VTP
set(toolkits_Presenters_Testing VTK) # reads the PNG of a report
set(toolkits_Devices_Servers Qt) # programs of their own
set(toolkits_Devices_Testing Qt) # a stand-in, likewise
set(toolkits_Phantom GDCM)
set(toolkits_Registration ITK)
set(toolkits_Segmentation ITK)
set(toolkits_Library GDCM DCMTK)
set(toolkits_Network DCMTK)
set(toolkits_Rendering VTK)
set(toolkits_Interaction VTK)

set(violations)

# violation(<file> <text of the #include> <message>)
function(violation file include message)
  # The line number is determined only here, by counting the lines before the match.
  file(READ ${file} text)
  string(FIND "${text}" "${include}" at)
  string(SUBSTRING "${text}" 0 ${at} before)
  string(REGEX REPLACE "[^\n]" "" before "${before}")
  string(LENGTH "${before}" line)
  math(EXPR line "${line} + 1")
  file(RELATIVE_PATH file ${TREE} ${file})
  set(violations ${violations} "${file}:${line}: ${message}" PARENT_SCOPE)
endfunction()

# Sets <result> to the toolkit of a header's name, or to nothing.
function(toolkit_of header result)
  set(toolkit)
  if(header MATCHES "^vtk[A-Za-z0-9_]*\\.h$")
    set(toolkit VTK)
  elseif(header MATCHES "^itk[A-Za-z0-9_]*\\.h(xx)?$")
    set(toolkit ITK)
  elseif(header MATCHES "^(gdcm-[0-9.]+/)?gdcm[A-Za-z0-9_]*\\.h$")
    set(toolkit GDCM)
  elseif(header MATCHES "^dcmtk/")
    set(toolkit DCMTK)
  elseif(header MATCHES "^(Qt[A-Z][A-Za-z]*/.*|Q[A-Z][A-Za-z0-9]*|QVTK[A-Za-z]*\\.h|q[a-z]+\\.h)$")
    set(toolkit Qt)
  endif()
  set(${result} "${toolkit}" PARENT_SCOPE)
endfunction()

# Sets <result> to the #include lines of a file, without line ends.
function(includes_of file result)
  file(READ ${file} text)
  string(REGEX MATCHALL "#[ \t]*include[ \t]*[<\"][^>\"\n]+[>\"]" includes "${text}")
  set(${result} "${includes}" PARENT_SCOPE)
endfunction()

function(sources_below result)
  set(patterns)
  foreach(folder IN LISTS ARGN)
    foreach(suffix h hpp cpp cxx txx)
      list(APPEND patterns ${folder}/*.${suffix})
    endforeach()
  endforeach()
  file(GLOB_RECURSE files ${patterns})
  set(${result} "${files}" PARENT_SCOPE)
endfunction()

include(${DECLARED})
set(files_read 0)

foreach(module IN LISTS PETROUS_MODULES)
  set(folder Modules/${module})
  if(folder_${module})
    set(folder ${folder_${module}})
  endif()
  set(declaration ${folder}/CMakeLists.txt)
  if(NOT module IN_LIST known_modules)
    list(APPEND violations
      "${declaration}: module ${module} has no row in the table of Testing/IncludeDependencies.cmake")
  endif()
  foreach(dependency IN LISTS PETROUS_DEPENDS_${module})
    if(module IN_LIST known_modules AND NOT dependency IN_LIST allowed_${module})
      list(JOIN allowed_${module} " " allowed)
      list(APPEND violations
        "${declaration}: ${module} must not depend on ${dependency} (allowed: ${allowed})")
    endif()
  endforeach()

  sources_below(files ${TREE}/${folder})
  foreach(file IN LISTS files)
    math(EXPR files_read "${files_read} + 1")
    includes_of(${file} includes)
    foreach(include IN LISTS includes)
      string(REGEX REPLACE "^#[ \t]*include[ \t]*[<\"]([^>\"]+)[>\"]$" "\\1" header "${include}")
      if(header MATCHES "^petrous/([A-Za-z]+)/")
        set(other ${CMAKE_MATCH_1})
        if(NOT other STREQUAL module AND NOT other IN_LIST PETROUS_DEPENDS_${module})
          violation(${file} "${include}"
            "includes ${header}, but ${declaration} does not declare 'DEPENDS ${other}'")
        endif()
        continue()
      endif()
      toolkit_of("${header}" toolkit)
      if(NOT toolkit)
        continue()
      endif()
      set(permitted ${toolkits_${module}})
      if(file MATCHES "/Testing/")
        list(APPEND permitted ${toolkits_${module}_Testing})
      elseif(file MATCHES "/Servers/")
        list(APPEND permitted ${toolkits_${module}_Servers})
      endif()
      if(NOT toolkit IN_LIST permitted)
        violation(${file} "${include}"
          "includes ${header}, but module ${module} must not include headers of ${toolkit}")
      elseif(toolkit MATCHES "^(ITK|GDCM|DCMTK)$" AND NOT file MATCHES "\\.(cpp|cxx)$")
        violation(${file} "${include}"
          "includes ${header}, but headers of ${toolkit} belong in .cpp files only")
      endif()
    endforeach()
  endforeach()
endforeach()

# The rest of the application may include every module.
sources_below(files ${TREE}/Application)
list(FILTER files EXCLUDE REGEX "/Application/Presenters/")
foreach(file IN LISTS files)
  math(EXPR files_read "${files_read} + 1")
  includes_of(${file} includes)
  foreach(include IN LISTS includes)
    string(REGEX REPLACE "^#[ \t]*include[ \t]*[<\"]([^>\"]+)[>\"]$" "\\1" header "${include}")
    if(header MATCHES "^petrous/([A-Za-z]+)/" AND NOT CMAKE_MATCH_1 IN_LIST known_modules)
      violation(${file} "${include}" "includes ${header}, but there is no module ${CMAKE_MATCH_1}")
    endif()
    toolkit_of("${header}" toolkit)
    if(toolkit MATCHES "^(ITK|GDCM|DCMTK)$" AND NOT file MATCHES "\\.(cpp|cxx)$")
      violation(${file} "${include}"
        "includes ${header}, but headers of ${toolkit} belong in .cpp files only")
    endif()
  endforeach()
endforeach()

if(violations)
  list(JOIN violations "\n" text)
  message("${text}")
  list(LENGTH violations count)
  message(FATAL_ERROR "${count} includes or declarations against the rules")
endif()
message(STATUS "${files_read} files keep to the declared dependencies")
