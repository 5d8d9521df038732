// A dull opaque surface: sky from all sides, sun by the cosine of its angle; hidden by the scene.
layout(binding = 0) uniform sampler2D sceneDepth;
uniform vec3 toSun;
uniform vec3 sky, sun;  // as the surface reflects them

in vec3 facing;
layout(location = 0) out vec4 colour;

void main() {
    if (gl_FragCoord.z < texelFetch(sceneDepth, ivec2(gl_FragCoord.xy), 0).r) discard;
    colour = vec4(sky + sun * max(dot(normalize(facing), toSun), 0.0), 1);
}
