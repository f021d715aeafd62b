// The pixel of the targets that an invocation is for: its fragment's, or with COMPUTE that of its place among all invocations.

ivec2 this_pixel() {
#ifdef COMPUTE
    return ivec2(gl_GlobalInvocationID.xy);
#else
    return ivec2(gl_FragCoord.xy);
#endif
}
