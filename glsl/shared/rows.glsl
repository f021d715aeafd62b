// Rows of mesh data, which are read by their numbers: texels of buffers, which drivers of CPUs gather for several invocations at once.
// STORAGE: elements of storage buffers, which hold more, and which such drivers read invocation by invocation.

#ifdef STORAGE
#define ROWS(place, Block, texels, kind, name) layout(set = 0, binding = place, std430) readonly buffer Block { kind list[]; } name
#define ROW(name, number) name.list[number]
#define COUNT_OF_ROWS(name) name.list.length()
#else
#define ROWS(place, Block, texels, kind, name) layout(set = 0, binding = place) uniform texels name
#define ROW(name, number) texelFetch(name, int(number))
#define COUNT_OF_ROWS(name) textureSize(name)
#endif
