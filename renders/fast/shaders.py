"""The shading model `fast/1` in GLSL.

Diffuse: the sky by spherical harmonics; every softbox as the disk of its area (Wallace, Elmquist,
Haines 1989), cut by the horizon as Hill (2016) approximates that of Heitz et al. (2016). Specular:
radiance filtered by roughness, and the split sum (Karis 2013), towards the lobe's dominant
direction.
"""

MOST_LIGHTS = 16
"""Their number is compiled in: a loop that is not unrolled costs as much as all the rest."""
DEFINES = {"color": "COLOR", "orm": "ORM", "normal": "NORMAL", "emission": "EMISSION"}
"""Kind of image to the name that compiles its lookup in."""

VERTEX = """
#version 330
uniform mat4 clip_from_rest;
uniform mat4 object_from_rest;
in vec3 in_position;
in vec3 in_normal;
in vec2 in_uv;
out vec3 place;
out vec3 normal;
out vec2 uv;

void main() {
    gl_Position = clip_from_rest * vec4(in_position, 1.0);
    place = (object_from_rest * vec4(in_position, 1.0)).xyz;
    normal = mat3(object_from_rest) * in_normal;
    uv = in_uv;
}
"""

LIGHT = """
#version 330
#define TAU 6.28318530718
uniform vec3 eye;
uniform vec3 sky[9];
#if LIGHTS > 0
uniform vec3 middles[LIGHTS];
uniform vec4 faces[LIGHTS];  // where each light faces, and its area
uniform vec3 radiance[LIGHTS];
#endif
uniform sampler2DArray mirrored;
uniform vec4 stage;  // middle of the rig, and the distance of its lights
uniform sampler3D seen_sky;
uniform sampler3D seen_lights;
uniform vec4 open_sky;
uniform vec4 grid;  // lower corner and size of a cell
in vec3 place;
in vec3 normal;
in vec2 uv;

vec3 sky_on(vec3 n) {
    return max(vec3(0.0), sky[0] + sky[1] * n.y + sky[2] * n.z + sky[3] * n.x
        + sky[4] * n.x * n.y + sky[5] * n.y * n.z + sky[6] * (3.0 * n.z * n.z - 1.0)
        + sky[7] * n.x * n.z + sky[8] * (n.x * n.x - n.y * n.y));
}

#if LIGHTS > 0
float form_factor(int light, vec3 n) {
    vec3 toward = middles[light] - place;
    float squared = dot(toward, toward), area = faces[light].w;
    toward *= inversesqrt(squared);
    float size = area * max(0.0, -dot(toward, faces[light].xyz)) / (0.5 * TAU * squared + area);
    return size * max(0.0, size + dot(toward, n)) / (size + 1.0);
}
#endif

vec4 cell(sampler3D image, vec3 n) {
    vec3 at = (place + n * grid.w - grid.xyz) / (grid.w * vec3(textureSize(image, 0)));
    return textureLod(image, at, 0.0);
}

float share(vec4 seen, vec3 direction, float gradient) {
    vec4 by = vec4(1.0, gradient * direction);
    return clamp(dot(seen, by) / max(dot(open_sky, by), 1e-6), 0.0, 1.0);
}

vec3 mirror(vec3 direction, float roughness) {
    vec3 from = place - stage.xyz;
    direction = normalize(direction);
    float along = dot(from, direction);
    float reach = sqrt(max(0.0, along * along - dot(from, from) + stage.w * stage.w)) - along;
    vec3 d = normalize(from + reach * direction);
    vec2 at = vec2(atan(d.x, -d.y) / TAU + 0.5, 0.5 - 2.0 * asin(clamp(d.z, -1.0, 1.0)) / TAU);
    float layer = roughness * float(textureSize(mirrored, 0).z - 1);
    float low = floor(layer);
    return mix(textureLod(mirrored, vec3(at, low), 0.0).rgb,
        textureLod(mirrored, vec3(at, low + 1.0), 0.0).rgb, layer - low);
}
"""

OPAQUE = (
    LIGHT
    + """
uniform vec3 color;
uniform vec3 glow;
uniform float roughness;
uniform float metallic;
uniform float specular;
uniform sampler2D split_sum;
#ifdef COLOR
uniform sampler2D color_image;
#endif
#ifdef ORM
uniform sampler2D orm_image;
#endif
#ifdef NORMAL
uniform sampler2D normal_image;
#endif
#ifdef EMISSION
uniform sampler2D emission_image;
#endif
out vec4 light;

vec3 bent(vec3 n) {
#ifdef NORMAL
    vec3 along_x = dFdx(place), along_y = dFdy(place);
    vec2 across_x = dFdx(uv), across_y = dFdy(uv);
    vec3 other_y = cross(along_y, n), other_x = cross(n, along_x);
    vec3 tangent = other_y * across_x.x + other_x * across_y.x;
    vec3 bitangent = -(other_y * across_x.y + other_x * across_y.y);
    float size = max(dot(tangent, tangent), dot(bitangent, bitangent));
    vec3 bump = texture(normal_image, uv).xyz * (255.0 / 127.0) - 128.0 / 127.0;
    vec3 turned = (tangent * bump.x + bitangent * bump.y) * inversesqrt(max(size, 1e-30));
    return normalize(turned + n * bump.z);
#else
    return n;
#endif
}

void main() {
    vec3 base = color, emitted = glow;
    float rough = roughness, metal = metallic;
#ifdef COLOR
    base = texture(color_image, uv).rgb;
#endif
#ifdef ORM
    vec3 orm = texture(orm_image, uv).rgb;
    rough = orm.g;
    metal = orm.b;
#endif
#ifdef EMISSION
    emitted *= texture(emission_image, uv).rgb;
#else
    emitted *= color;
#endif
    vec3 n = bent(normalize(normal));
    vec3 to_eye = normalize(eye - place);
    float facing = max(dot(n, to_eye), 1e-3);
    vec2 split = texture(split_sum, vec2(facing, rough)).rg;
    vec4 sky_seen = cell(seen_sky, n), lights_seen = cell(seen_lights, n);
    vec3 open = sky_on(n), arriving = open * share(sky_seen, n, 2.0);
#if LIGHTS > 0
    for (int k = 0; k < LIGHTS; ++k) {
        vec3 from = radiance[k] * form_factor(k, n);
        open += from;
        arriving += k < 4 ? from * lights_seen[k] : from;
    }
#endif
    // Blocked light bounces until it leaves by the open share: a geometric series, of which half
    // the walls have the surface's own color and half are dark.
    vec3 returned = base * sky_seen.x / (1.0 - 0.5 * base * (1.0 - sky_seen.x));
    vec3 shown = arriving + returned * (open - arriving);
    vec3 straight = mix(vec3(specular), base, metal);
    vec3 reflected = straight * split.x + min(50.0 * straight.g, 1.0) * split.y;
    vec3 diffuse = base * (1.0 - metal) * (1.0 - reflected.g);
    float smooth_share = 1.0 - rough * rough;
    vec3 sheen = mirror(mix(n, reflect(-to_eye, n), smooth_share), rough);
    float clear = share(sky_seen, reflect(-to_eye, n), 3.0 - rough);
    sheen = mix(base * sqrt(sky_seen.x) * open, sheen, clear);
    light = vec4(diffuse * shown + reflected * sheen + emitted, 0.0);
}
"""
)

PANE = (
    LIGHT
    + """
uniform float index;
uniform float roughness;
uniform vec3 tint;
layout(location = 0, index = 0) out vec4 light;
layout(location = 0, index = 1) out vec4 passed;

float fresnel(float c) {
    float g = sqrt(index * index - 1.0 + c * c);
    float a = (g - c) / (g + c), b = (c * (g + c) - 1.0) / (c * (g - c) + 1.0);
    return 0.5 * a * a * (1.0 + b * b);
}

void main() {
    vec3 to_eye = normalize(eye - place), n = normalize(normal);
    n = faceforward(n, -to_eye, n);
    float share = fresnel(abs(dot(n, to_eye)));
    vec3 through = tint * (1.0 - share);
    light = vec4(share * mirror(reflect(-to_eye, n), roughness), 0.0);
    passed = vec4(through, dot(through, vec3(1.0 / 3.0)));
}
"""
)
