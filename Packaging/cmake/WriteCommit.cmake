# Writes OUT, a source that defines petrous::cli::kCommit: the commit that TREE stands on, with
# "-dirty" where its files differ from it, "unknown" where TREE is no git checkout. OUT is touched
# only where that changed.
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
