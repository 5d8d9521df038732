# Writes HEADER: one `constexpr gpu::ShaderFile` per shader file of a module; error messages use the file names.
# cmake -DMODULE=… -DHEADER=… -DFILES="a;b" -P embed_shaders.cmake
set(TEXT "// Generated from the shader files of ${MODULE}.\n#pragma once\n#include \"methods/kit/gpu/shader_file.h\"\n\n")
string(APPEND TEXT "namespace dustbench::${MODULE}_shaders {\n")
foreach(FILE ${FILES})
  get_filename_component(NAME ${FILE} NAME)
  string(MAKE_C_IDENTIFIER ${NAME} IDENTIFIER)
  file(READ ${FILE} SOURCE)
  string(APPEND TEXT "inline constexpr gpu::ShaderFile ${IDENTIFIER}{\"${MODULE}/${NAME}\", R\"glsl(${SOURCE})glsl\"};\n")
endforeach()
string(APPEND TEXT "}  // namespace dustbench::${MODULE}_shaders\n")
file(WRITE ${HEADER} "${TEXT}")
