# The kernels, once per instruction set. One binary holds them all and chooses at run time (dispatch.cpp).
#
# A multiply and an add may be fused here: every cell goes through the same instructions in whatever lane, pack or thread,
# so its bits stay its own; only between instruction sets do they differ in the last digits. Fields of numbers are read as
# packs, which strict aliasing would forbid.
#
# Sanitizers stay outside: instrumented, one of these files takes the compiler many minutes. What the kernels touch is
# laid out, and bounded, by code that is instrumented; run valgrind on test_cpu after a change here. A build for the
# sanitizers has the baseline kernels only, made quickly.
set(NPFEM_KERNEL_OPTIONS -O3 -ffp-contract=fast -fno-strict-aliasing -fno-math-errno)
if(NPFEM_SANITIZE)
  list(APPEND NPFEM_KERNEL_OPTIONS -O1 -fno-sanitize=all)
endif()

function(npfem_kernels instruction_set)
  add_library(npfem_kernels_${instruction_set} OBJECT backend/cpu/kernel_${instruction_set}.cpp)
  npfem_target(npfem_kernels_${instruction_set})
  target_include_directories(npfem_kernels_${instruction_set} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  target_compile_options(npfem_kernels_${instruction_set} PRIVATE ${NPFEM_KERNEL_OPTIONS} ${ARGN})
  target_sources(npfem_core PRIVATE $<TARGET_OBJECTS:npfem_kernels_${instruction_set}>)
endfunction()

npfem_kernels(baseline)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64" AND NOT NPFEM_SANITIZE)
  npfem_kernels(avx2 -mavx2 -mfma)
  npfem_kernels(avx512 -mavx2 -mfma -mavx512f -mavx512dq -mavx512vl -mavx512bw -mprefer-vector-width=512)
  target_compile_definitions(npfem_core PRIVATE NPFEM_X86_KERNELS)
endif()

if(NPFEM_OPENMP)
  find_package(OpenMP COMPONENTS CXX)
  if(OpenMP_CXX_FOUND)
    target_link_libraries(npfem_core PUBLIC OpenMP::OpenMP_CXX)
  endif()
endif()
