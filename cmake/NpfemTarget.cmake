# One place for compiler settings: every target of this project passes through npfem_target().
include_guard(GLOBAL)

function(npfem_target target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF C_EXTENSIONS OFF
                        CXX_VISIBILITY_PRESET hidden C_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion
    # One input gives one bit pattern, vectorised or not: a multiply and an add are never fused behind our back.
    -ffp-contract=off)
  if(NPFEM_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(NPFEM_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${NPFEM_SANITIZE} -fno-omit-frame-pointer
                           -fno-sanitize-recover=all)
    target_link_options(${target} PUBLIC -fsanitize=${NPFEM_SANITIZE})
  endif()
endfunction()
