# cmake -DOBJECTS=... -DINSTRUCTION_SET=avx2 -DNM=nm -P check_kernel_symbols.cmake
# The linker keeps one of the definitions that share a name, wherever it was compiled: a function of the kernels without
# their instruction set in its name could run on a machine that lacks its instructions. Every name that the kernels
# define for others must carry the namespace npfem::<instruction set>, its own or of a type that it is made for.
list(JOIN OBJECTS " " objects)
execute_process(COMMAND ${NM} --defined-only --extern-only ${OBJECTS} OUTPUT_VARIABLE listing COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "[0-9a-f]+ [A-Za-z] [^\n]+" symbols "${listing}")
list(LENGTH symbols count)
if(count LESS 10)
  message(FATAL_ERROR "${objects} defines only ${count} symbols; was the right file looked at?")
endif()
string(LENGTH ${INSTRUCTION_SET} length)
set(shared)
foreach(symbol IN LISTS symbols)
  if(NOT symbol MATCHES "5npfem[^ ]*${length}${INSTRUCTION_SET}")
    list(APPEND shared "${symbol}")
  endif()
endforeach()
if(shared)
  list(JOIN shared "\n" shared)
  message(FATAL_ERROR "${objects} defines symbols without npfem::${INSTRUCTION_SET} in their names:\n${shared}")
endif()
message(STATUS "${INSTRUCTION_SET}: ${count} symbols, all its own")
