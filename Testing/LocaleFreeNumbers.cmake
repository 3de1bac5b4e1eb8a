# Numbers are written and read by Core/NumberText.h, and letters change their case by
# Core/AsciiCase.h, which are locale-independent: no source of a module or of the application uses
# functions that depend on LC_NUMERIC, LC_CTYPE or the global std::locale.
#
#   cmake -D TREE=<top> -P LocaleFreeNumbers.cmake
#
# Starts with a self-test.

# Sets `result` to the violation in a source's text; empty: none.
function(violation text result)
  set(${result} "" PARENT_SCOPE)
  # ';' and brackets have a meaning in CMake lists
  string(REPLACE "[" " " text "${text}")
  string(REPLACE "]" " " text "${text}")
  string(REGEX REPLACE "//[^\n]*" "" text "${text}")
  string(REPLACE ";" "@" text "${text}")
  if(text MATCHES "(std::sto[fd]|std::stold|strto[fd]|strtold|[^a-z]atof) *\\(")
    set(${result} "${CMAKE_MATCH_1} follows the locale" PARENT_SCOPE)
    return()
  endif()
  if(text MATCHES "std::(tolower|toupper)|[^A-Za-z:](tolower|toupper) *\\(")
    set(${result} "${CMAKE_MATCH_0} follows the locale" PARENT_SCOPE)
    return()
  endif()
  string(REGEX MATCHALL "[a-z]*(printf|scanf)[^@]*@" calls "${text}")
  foreach(call IN LISTS calls)
    if(NOT call MATCHES "\"" OR call MATCHES "%[-+ #0-9.*]*(l|L)?[aefgAEFG]")
      set(${result} "${call} follows the locale" PARENT_SCOPE)
      return()
    endif()
  endforeach()
  # streams used only for raw file content do not format numbers
  if(text MATCHES "[^i]o?stringstream [a-z]" AND
     NOT text MATCHES "imbue\\(std::locale::classic\\(\\)\\)|rdbuf\\(\\)")
    set(${result} "a stream without imbue(std::locale::classic()) follows the locale" PARENT_SCOPE)
  endif()
endfunction()

foreach(bad "x = std::stod(text)\;" "x = strtod(text, 0)\;" "std::snprintf(t, 9, \"%5.2f\", x)\;"
    "std::snprintf(t, 9, format, x)\;" "std::sscanf(t, \"%lf\", &x)\;" "std::ostringstream s\; s << x\;"
    "std::stringstream s\; s >> x\;"
    "c = std::tolower(c)\;" "c = toupper(c)\;")
  violation("${bad}" seen)
  if(NOT seen)
    message(FATAL_ERROR "not seen: ${bad}")
  endif()
endforeach()
foreach(good "std::snprintf(t, 9, \"%04d\", n)\;" "// snprintf(t, 9, \"%g\", x)\;\n"
    "std::ostringstream s\; s << file.rdbuf()\;" "x = std::stoi(text)\;"
    "std::istringstream words(line)\;"
    "text.toLower()\;" "c = core::asciiLower(c)\;")
  violation("${good}" seen)
  if(seen)
    message(FATAL_ERROR "wrongly seen in ${good}: ${seen}")
  endif()
endforeach()

file(GLOB_RECURSE files ${TREE}/Modules/*.cpp ${TREE}/Modules/*.cxx ${TREE}/Modules/*.h
  ${TREE}/Application/*.cpp ${TREE}/Application/*.h)
list(FILTER files EXCLUDE REGEX "/Testing/")
list(LENGTH files count)
if(count LESS 100)
  message(FATAL_ERROR "only ${count} sources found below ${TREE}")
endif()
foreach(file IN LISTS files)
  file(READ ${file} text)
  violation("${text}" seen)
  if(seen)
    file(RELATIVE_PATH name ${TREE} ${file})
    message(SEND_ERROR "${name}: ${seen}; use Core/NumberText.h, Core/AsciiCase.h")
  endif()
endforeach()
