// Surfaces that let something through: a ray meets each of them wherever it crosses its value, from either side, and goes on behind
// [Stegmaier05 §6]. IN_VOLUME: they stand within the colours of the volume. Twin: src/twin/crossings.rs. Needs frame.glsl,
// samples.glsl, volume.glsl, surface.glsl, root.glsl, surface_color.glsl, shade.glsl and projection.glsl, and `is_done` of
// single_pass.glsl.
//
// A place lies within as many surfaces as its value has reached, since they rise by their values. A ray crosses one after the other:
// up through the next, or down through the last.
//
// CLIP_VOLUME: surfaces are crossed in what is kept alone; where a ray comes into that within some, it meets the innermost, as where it
// begins.

// How far rounding may lead the interpolant beyond the corners of its cell, relative (SLACK in src/projection/row.rs).
const float INTERPOLATION_ROUNDING = exp2(-20.0);

#ifdef IN_VOLUME
// What is left of a step of the volume, behind the surfaces that were crossed in it.
struct Rest {
    // Where it begins, in steps.
    float begin;
#ifdef PREINTEGRATED
    // The value there.
    float value;
#else
    vec4 color;
    float clear;
#endif
#ifdef CLIP_VOLUME
    // Whether its sample is clipped, so that it shows nothing.
    bool hidden;
#endif
};

// Puts the volume up to a place, in steps, at which it has `value`, under what the ray holds.
void show_until(float steps, float value, inout Rest rest, inout vec4 held) {
#ifdef CLIP_VOLUME
    if (rest.hidden) {
        return;
    }
#endif
    float extent = max(steps - rest.begin, 0.0);
#ifdef PREINTEGRATED
    held = joined(held, part_of(classify_between(node_of(rest.value), node_of(value)), extent));
    rest.value = value;
#else
    held = joined(held, over_steps(rest.color, rest.clear, extent));
#endif
    rest.begin = steps;
}
#else
// There is nothing between surfaces.
struct Rest {
    float begin;
};

void show_until(float steps, float value, inout Rest rest, inout vec4 held) {}
#endif

// The value at the end of a step, by which it is known within how many surfaces the ray is there: that of the interpolant, where
// crossings are its roots.
float crossed_value(Ray ray, float steps) {
    return REFINE == CUBIC ? burdened(sample_exact(place_at(ray, steps))) : sample_volume(ray, steps);
}

// Puts the surface under what the ray holds that it crosses at a place, up or down, and in front of it the volume up to there.
void cross_at(Ray ray, float steps, float value, bool up, inout int within, inout Rest rest, inout vec4 held) {
    show_until(steps, value, rest, held);
    if (!is_done(held)) {
        held = joined(held, color_where(ray, Meeting(steps, up ? within : within - 1)));
    }
    within += up ? 1 : -1;
}

// Those on a stretch on which the value goes evenly from `front` to `back`, or that are met where it ends.
void cross_evenly(Ray ray, vec2 stretch, float front, float back, inout int within, inout Rest rest, inout vec4 held) {
    int to = surfaces_around(back);
    bool up = to > within;
    while (within != to && !is_done(held)) {
        float level = surface_levels.list[up ? within : within - 1].from;
        if (REFINE == LINEAR) {
            float share = clamp((level - front) / (back - front), 0.0, 1.0);
            cross_at(ray, mix(stretch.x, stretch.y, share), level, up, within, rest, held);
        } else {
            cross_at(ray, stretch.y, back, up, within, rest, held);
        }
        // Asked at the end as well, here and below: segment.glsl.
        if (within == to || is_done(held)) {
            break;
        }
    }
}

// The first s in [from, 1] at which it is no longer so that the cubic has not reached 0 (`up`), or that it has; more than 1 where it
// stays so.
float first_change(vec4 c, bool up, float from) {
    vec2 turns = turns_of(c);
    for (int piece = 0; piece < 3; ++piece) {
        float to = piece < 2 ? min(turns[piece], 1.0) : 1.0;
        if (to <= from && piece < 2) {
            continue;
        }
        if ((cubic_at(c, from) >= 0.0) == up) {
            return from;
        }
        if ((cubic_at(c, to) >= 0.0) == up) {
            for (int i = 0; i < HALVINGS; ++i) {
                float middle = 0.5 * (from + to);
                if ((cubic_at(c, middle) >= 0.0) == up) {
                    to = middle;
                } else {
                    from = middle;
                }
            }
            return to;
        }
        from = to;
    }
    return 2.0;
}

// Those on the part from `at` to `leave`, in steps from `begin` on, which lies in one cell: the cubic's roots, in their order.
void cross_in_cell(Ray ray, float begin, vec2 part, float corners[8], vec3 from, vec3 rise,
                   inout int within, inout Rest rest, inout vec4 held) {
    // Without a number taken off, the cubics of all values are alike but for their first coefficient.
    vec4 cubic = cubic_of(corners, from, rise);
    int count = surface_levels.list.length();
    float s = 0.0;
    while (!is_done(held)) {
        float up = 2.0;
        float down = 2.0;
        if (within < count) {
            up = first_change(cubic - vec4(surface_levels.list[within].from, 0.0, 0.0, 0.0), true, s);
        }
        if (within > 0) {
            down = first_change(cubic - vec4(surface_levels.list[within - 1].from, 0.0, 0.0, 0.0), false, s);
        }
        s = min(up, down);
        if (s > 1.0) {
            return;
        }
        float level = surface_levels.list[up <= down ? within : within - 1].from;
        cross_at(ray, begin + mix(part.x, part.y, s), level, up <= down, within, rest, held);
    }
}

// Those on a stretch by the interpolant itself, from cell to cell.
void cross_exactly(Ray ray, vec2 stretch, inout int within, inout Rest rest, inout vec4 held) {
    CellWalk walk = walk_from(ray, stretch.x);
    float length = stretch.y - stretch.x;
    while (walk.at < length && !is_done(held)) {
        CellPart part = next_part(walk, length);
        float corners[8];
        corners_of(part.below, 0.0, corners);
        float least = corners[0];
        float most = corners[0];
        for (int corner = 1; corner < 8; ++corner) {
            least = min(least, corners[corner]);
            most = max(most, corners[corner]);
        }
        float slack = INTERPOLATION_ROUNDING * max(abs(least), abs(most));
        if (surfaces_around(least - slack) != within || surfaces_around(most + slack) != within) {
            cross_in_cell(ray, stretch.x, part.steps, corners, part.from, part.to - part.from, within, rest, held);
        }
        if (walk.at >= length || is_done(held)) {
            break;
        }
    }
}

// Those on a stretch between whose ends values go from `front` to `back`.
void cross_between(Ray ray, vec2 stretch, float front, float back, inout Rest rest, inout vec4 held) {
    int within = surfaces_around(front);
    if (REFINE == CUBIC) {
        cross_exactly(ray, stretch, within, rest, held);
        // What rounding hides from the cubic and not from the value.
        int to = surfaces_around(back);
        bool up = to > within;
        while (within != to && !is_done(held)) {
            cross_at(ray, stretch.y, back, up, within, rest, held);
            if (within == to || is_done(held)) {
                break;
            }
        }
    } else {
        cross_evenly(ray, stretch, front, back, within, rest, held);
    }
}

#ifdef CLIP_VOLUME
// Those on what is kept of a stretch, with the innermost that the ray comes into it within.
void cross_kept(Ray ray, vec2 stretch, float front, float back, inout Rest rest, inout vec4 held) {
    KeptPart part = kept_part(ray, stretch);
    if (!part.any_part) {
        return;
    }
    if (part.enters) {
        front = crossed_value(ray, part.between.x);
        int within = surfaces_around(front);
        if (within > 0) {
            show_until(part.between.x, front, rest, held);
            if (!is_done(held)) {
                held = joined(held, color_where(ray, Meeting(part.between.x, within - 1)));
            }
        }
    } else if (part.between.y < stretch.y) {
        back = crossed_value(ray, part.between.y);
    }
    if (!is_done(held)) {
        cross_between(ray, part.between, front, back, rest, held);
    }
}
#endif

// Joins the step after sample `i`, at whose begin the ray has the value `front`, with what the ray holds.
void cross_step(Ray ray, uint i, inout float front, inout vec4 held) {
    vec2 stretch = stretch_after(ray, i);
    float back = crossed_value(ray, stretch.y);
    Rest rest;
    rest.begin = stretch.x;
#if defined(IN_VOLUME) && defined(PREINTEGRATED)
    rest.value = front;
#elif defined(IN_VOLUME)
    rest.color = color_of_sample(ray, i, rest.clear);
#endif
#ifdef CLIP_VOLUME
#ifdef IN_VOLUME
    rest.hidden = !is_kept(ray, steps_to(i));
#endif
    cross_kept(ray, stretch, front, back, rest, held);
#else
    cross_between(ray, stretch, front, back, rest, held);
#endif
    if (!is_done(held)) {
        show_until(stretch.y, back, rest, held);
    }
    front = back;
}

// The innermost surface that a ray begins within, which it meets there.
void cross_begin(Ray ray, float steps, inout vec4 held) {
#ifdef CLIP_VOLUME
    if (!is_kept(ray, steps)) {
        return;
    }
#endif
    int within = surfaces_around(crossed_value(ray, steps));
    if (within > 0) {
        held = joined(held, color_where(ray, Meeting(steps, within - 1)));
    }
}
