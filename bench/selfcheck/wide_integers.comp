#extension GL_ARB_gpu_shader_int64 : require
layout(local_size_x = 1) in;
layout(std430, binding = 0) buffer Words { uvec2 words[]; };

void main() {
    const uint64_t a = packUint2x32(words[0]), b = packUint2x32(words[1]);
    words[2] = unpackUint2x32(a * b + (a >> 7) - (b << 3));
}
