// Pre-integrated classification: what the transfer function makes of all values between those at the two ends of a
// step, from a table. Takes the place of transfer.glsl. Twin: src/truth/preintegrated.rs. Needs volume.glsl and
// opacity.glsl.

// A piece of the table's axes: one of the transfer function's, or what lies beyond them all. Nodes are evenly spaced in it.
struct AxisPiece {
    // Where it begins (units of the volume texture), and 1 / its length (0 for one of no length).
    float begin;
    float inverse_length;
    // Its first node, and the number of its last one counted from there.
    float first;
    float intervals;
};

layout(set = 0, binding = 5, std430) readonly buffer Axis {
    AxisPiece pieces[];
} axis;
// Premultiplied colour and opacity of a whole step: front value along x, back value along y.
layout(set = 0, binding = 11) uniform sampler2D preintegrated;

// As in transfer.glsl, of the axes' pieces.
layout(constant_id = 2) const int PIECES = 1;
layout(constant_id = 3) const int SEARCH = 0;
// Opacities are brought from the step to its part as those of the transfer function are.
layout(constant_id = 4) const bool CORRECT_OPACITY = false;

// Place of a scalar value on the table's axes, in nodes.
float node_of(float value) {
    int at = 0;
    for (int width = SEARCH; width > 0; width >>= 1) {
        if (at + width < PIECES && value >= axis.pieces[at + width].begin) {
            at += width;
        }
    }
    AxisPiece piece = axis.pieces[at];
    float weight = clamp((value - piece.begin) * piece.inverse_length, 0.0, 1.0);
    return piece.first + weight * piece.intervals;
}

// Premultiplied colour of a whole step whose values go from that of node `front` to that of node `back`.
vec4 classify_between(float front, float back) {
    ivec2 last = textureSize(preintegrated, 0) - 1;
    ivec2 a = min(ivec2(front, back), last);
    ivec2 b = min(a + 1, last);
    vec4 low = mix_fused(texelFetch(preintegrated, a, 0), texelFetch(preintegrated, ivec2(b.x, a.y), 0), front - float(a.x));
    vec4 high = mix_fused(texelFetch(preintegrated, ivec2(a.x, b.y), 0), texelFetch(preintegrated, b, 0), front - float(a.x));
    return mix_fused(low, high, back - float(a.y));
}

// The same for a part of a step, in steps: its opacity exactly, its colour as if it were one all along.
vec4 part_of(vec4 whole, float steps) {
    if (steps == 1.0 || whole.a <= 0.0) {
        return whole;
    }
    float alpha = CORRECT_OPACITY ? corrected_opacity(whole.a, 1.0 - whole.a, steps) : whole.a * steps;
    return vec4(whole.rgb * (alpha / whole.a), alpha);
}
