// C = M·min(S, limit)
layout(binding = 0) uniform sampler2D source;
uniform mat4 mixing;
uniform float limit;

layout(location = 0) out vec4 colour;

void main() {
    colour = mixing * min(texelFetch(source, ivec2(gl_FragCoord.xy), 0), vec4(limit));
}
