layout(location = 0) in vec3 sight;
layout(location = 0) out vec4 colour;

void main() {
    vec3 direction = sight * inversesqrt(dot(sight, sight));
    // The disc's radius is 0.27°; its rim is softened over about a pixel.
    float disc = smoothstep(1.9e-5, 0.7e-5, 1.0 - dot(direction, toSun.xyz)) * step(0.0, direction.y);
    colour = vec4(skyColour(direction) + sun.rgb * (40.0 * disc), 1.0);
}
