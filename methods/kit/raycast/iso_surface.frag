// A matt opaque surface: sky light from all directions, sun light by Lambert's cosine; hidden by the scene.
layout(binding = 0) uniform sampler2D sceneDepth;
uniform vec3 toSun;
uniform vec3 sky, sun;  // reflected light

in vec3 facing;
layout(location = 0) out vec4 colour;

void main() {
    if (gl_FragCoord.z < texelFetch(sceneDepth, ivec2(gl_FragCoord.xy), 0).r) discard;
    colour = vec4(sky + sun * max(dot(normalize(facing), toSun), 0.0), 1);
}
