# What all objects of a WebAssembly module are compiled with; included after dpl_options is made. DPL_WASM says
# which of three modules: scalar runs everywhere, simd128 and threads where the browser has them.
set(DPL_WASM scalar CACHE STRING "scalar, simd128 or threads (which has simd128 too)")
set_property(CACHE DPL_WASM PROPERTY STRINGS scalar simd128 threads)
# A page loads this code: everything is made small, and what takes the time fast (src/CMakeLists.txt). Optimised where
# it is linked: smaller, and holographic frames take half as long.
set(CMAKE_C_FLAGS_RELEASE "-Oz -DNDEBUG -flto")
target_compile_definitions(dpl_options INTERFACE DPL_WITHOUT_HALF_ROWS DPL_WITHOUT_SOLID_SHADOWS)
set(wasm_features -mbulk-memory -mnontrapping-fptoint -msign-ext)
if(NOT DPL_WASM STREQUAL scalar)
  list(APPEND wasm_features -msimd128)
endif()
if(DPL_WASM STREQUAL threads)
  list(APPEND wasm_features -matomics)
endif()
target_compile_options(dpl_options INTERFACE ${wasm_features} -ffunction-sections)
