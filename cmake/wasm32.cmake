# Toolchain: WebAssembly by plain clang and wasi-libc. Used by the presets wasm, wasm-scalar and wasm-threads.
set(CMAKE_SYSTEM_NAME Generic) # CMake has no name for WASI before 3.31
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_C_COMPILER clang-14)
set(CMAKE_C_COMPILER_TARGET wasm32-wasi)
# What is asked of a compiler while CMake configures is not run.
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
