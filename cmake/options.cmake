# dpl_options: what every target of this project is compiled with.
add_library(dpl_options INTERFACE)
target_compile_features(dpl_options INTERFACE c_std_17)
# No contraction: the same bytes from every compiler and instruction set. No errno: sqrt is one instruction.
target_compile_options(dpl_options INTERFACE
  -ffp-contract=off -fno-math-errno -fvisibility=hidden
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wmissing-prototypes -Wstrict-prototypes -Wvla)
if(DPL_WERROR)
  target_compile_options(dpl_options INTERFACE -Werror)
endif()
if(DPL_SANITIZE)
  target_compile_options(dpl_options INTERFACE
    -fsanitize=${DPL_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer -g)
  target_link_options(dpl_options INTERFACE -fsanitize=${DPL_SANITIZE})
endif()
if(DPL_FUZZ) # the library tells the fuzzer which branches were taken, and stops at the first mistake
  set(fuzz_sanitizers -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all)
  target_compile_options(dpl_options INTERFACE ${fuzz_sanitizers})
  target_link_options(dpl_options INTERFACE ${fuzz_sanitizers})
endif()
set(CMAKE_C_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
