# Writes OUT, a source file that defines petrous::cli::kCommit: the commit checked out in TREE, with
# "-dirty" if files differ from it, "unknown" if TREE is not a git checkout. OUT is written only if
# it changes.
set(commit unknown)
find_program(GIT git)
if(GIT)
  execute_process(COMMAND ${GIT} -C ${TREE} describe --always --dirty --abbrev=12 --exclude=*
    OUTPUT_VARIABLE found OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE failed ERROR_QUIET)
  if(NOT failed)
    set(commit ${found})
  endif()
endif()
file(CONFIGURE OUTPUT ${OUT} CONTENT
  "namespace petrous::cli\n{\nextern const char* const kCommit;\nconst char* const kCommit = \"${commit}\";\n}\n")
