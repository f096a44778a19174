# Writes the version header; run by every build (target sazare_version).
set(SAZARE_VERSION "${VERSION}")
set(SAZARE_COMMIT "unknown")
find_program(GIT_PROGRAM git)
if(GIT_PROGRAM)
  execute_process(COMMAND "${GIT_PROGRAM}" -C "${SOURCE}" describe --always --dirty --abbrev=12 --exclude=*
    OUTPUT_VARIABLE described OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
  if(NOT failed)
    set(SAZARE_COMMIT "${described}")
  endif()
endif()
configure_file("${TEMPLATE}" "${HEADER}" @ONLY)
