// Iso-surfaces: which values are on one [KW03 §2.2, Weiler03 "Isosurface Ray Casting", Thesis ch. 5 §3.2].
// Twin: src/twin/surface.rs; the values are those of src/projection/surface.rs.

struct SurfaceLevel {
    // Linear, not lit; in alpha its opacity.
    vec4 color;
    // The values that are on the surface (units of the volume texture), from the one to the other.
    float from;
    float to;
};

// By rising values.
layout(set = 0, binding = 19, std430) readonly buffer SurfaceLevels {
    SurfaceLevel list[];
} surface_levels;

// The surface that a value is on, the last of several; -1 where it is on none.
int level_of(float value) {
    for (int i = surface_levels.list.length() - 1; i >= 0; --i) {
        if (surface_levels.list[i].from <= value && value <= surface_levels.list[i].to) {
            return i;
        }
    }
    return -1;
}

// Within how many surfaces a value is.
int surfaces_around(float value) {
    // Down from the last one, as above: of a loop that counts up, lavapipe of Mesa 26 makes code that ends the program.
    for (int i = surface_levels.list.length() - 1; i >= 0; --i) {
        if (value >= surface_levels.list[i].from) {
            return i + 1;
        }
    }
    return 0;
}
