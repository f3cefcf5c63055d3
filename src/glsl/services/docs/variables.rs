//! Says what the site's uniforms, the variables of chapter 7 and the entry points are.

/// Name and text.
#[rustfmt::skip]
pub(super) const VARIABLES: &[(&str, &str)] = &[
    // The site's uniforms.
    ("iResolution", "Size of what this pass draws, in pixels; z is the shape of a pixel, always 1. A cubemap pass has \
                     1024 x 1024."),
    ("iTime", "Seconds since the start or the last reset. Stands still while paused."),
    ("iTimeDelta", "Seconds from the last frame to this one. 1/60 in the first frame after a reset or a pause, and in \
                    frames that are drawn while paused."),
    ("iFrame", "Number of the frame, 0 after a reset: `iFrame == 0` is where a buffer sets itself up."),
    ("iFrameRate", "Frames a second, measured over the last half second and constant in between: not 1 / iTimeDelta."),
    ("iMouse", "The mouse, in whole pixels from the bottom left. xy: where it is while the button is held, or was \
                last. abs(zw): where the button went down. z > 0 while it is held; w > 0 only in the first frame of a \
                press. All 0 before the first one."),
    ("iDate", "Year, month from 0 to 11, day from 1 to 31, and seconds since midnight in local time."),
    ("iChannelTime", "For each channel, seconds into its video or music; 0 for what has no time."),
    ("iChannelResolution", "For each channel, its size in texels: width, height, depth (1 for pictures). (0, 0, 0) \
                            while nothing is loaded."),
    ("iSampleRate", "Samples of sound a second: always 44100."),
    ("iTimeOffset", "Seconds into the sound where the block being computed begins. Sound passes only; `mainSound` gets \
                     the time itself."),
    ("iSampleOffset", "Number of the first sample of the block being computed. Sound passes only."),
    ("iGlobalTime", "The old name of `iTime`."),
    ("iChannel0", "What is bound to channel 0: a picture, a buffer, the keyboard. Read it by `texture` or \
                   `texelFetch`. Opaque black, and of size 0, where nothing is."),
    ("iChannel1", "What is bound to channel 1: a picture, a buffer, the keyboard. Read it by `texture` or \
                   `texelFetch`. Opaque black, and of size 0, where nothing is."),
    ("iChannel2", "What is bound to channel 2: a picture, a buffer, the keyboard. Read it by `texture` or \
                   `texelFetch`. Opaque black, and of size 0, where nothing is."),
    ("iChannel3", "What is bound to channel 3: a picture, a buffer, the keyboard. Read it by `texture` or \
                   `texelFetch`. Opaque black, and of size 0, where nothing is."),
    ("iCh0", "Channel 0 as a struct, in Image only: `sampler`, `size`, `time` and `loaded`."),
    ("iCh1", "Channel 1 as a struct, in Image only: `sampler`, `size`, `time` and `loaded`."),
    ("iCh2", "Channel 2 as a struct, in Image only: `sampler`, `size`, `time` and `loaded`."),
    ("iCh3", "Channel 3 as a struct, in Image only: `sampler`, `size`, `time` and `loaded`."),
    ("iModel", "`mat4`: from the mesh to the world, as the draw's scale, rotation and position say. In passes that \
                draw meshes only."),
    ("iView", "`mat4`: from the world to the camera, which looks along its -z. In passes that draw meshes only."),
    ("iProjection", "`mat4`: from the camera to clip space, as GL has it. In passes that draw meshes only."),
    ("iNormalMatrix", "`mat3`: from the mesh's normals to the world's; normalise what comes of it. In passes that draw \
                       meshes only."),
    ("iCameraPosition", "`vec3`: where the camera stands in the world. In passes that draw meshes only."),
    // Section 7.1.
    ("gl_Position", "Where the vertex lies in clip space; to be written. Vertex stages only."),
    ("gl_PointSize", "Size of a point. Meshes are triangles, so it means nothing. Vertex stages only."),
    ("gl_VertexID", "Number of the vertex in its mesh. Vertex stages only."),
    ("gl_InstanceID", "Number of the instance: 0. Vertex stages only."),
    // Section 7.2.
    ("gl_FragCoord", "The pixel: xy is its centre from the bottom left (the first is at 0.5, 0.5), z the depth, w is 1 \
                      (of a mesh: one through the clip space's). `fragCoord` is its xy."),
    ("gl_FrontFacing", "Whether the triangle shows its front: always true but for meshes, as a pass draws one over the \
                        whole picture."),
    ("gl_PointCoord", "Place within a point. A pass draws no points, so it is (0, 0)."),
    ("gl_FragDepth", "The depth to write, 0 to 1. Only passes that draw meshes have a depth buffer; elsewhere nobody \
                      reads it."),
    // Section 7.3 and 7.4.
    ("gl_DepthRange", "Depths of the window: near 0, far 1, diff 1."),
    ("gl_MaxVertexAttribs", "How many attributes a vertex shader may have. Here the least that the language promises."),
    ("gl_MaxVertexUniformVectors", "How many vec4 of uniforms a vertex shader may have. Here the least that the \
                                    language promises."),
    ("gl_MaxVertexOutputVectors", "How many vec4 a vertex shader may hand on. Here the least that the language \
                                   promises."),
    ("gl_MaxFragmentInputVectors", "How many vec4 a fragment shader may receive. Here the least that the language \
                                    promises."),
    ("gl_MaxVertexTextureImageUnits", "How many textures a vertex shader may read. Here the least that the language \
                                       promises."),
    ("gl_MaxCombinedTextureImageUnits", "How many textures both shaders together may read. Here the least that the \
                                         language promises."),
    ("gl_MaxTextureImageUnits", "How many textures a fragment shader may read. Here the least that the language \
                                 promises; a pass has four channels."),
    ("gl_MaxFragmentUniformVectors", "How many vec4 of uniforms a fragment shader may have. Here the least that the \
                                      language promises."),
    ("gl_MaxDrawBuffers", "How many targets a fragment shader may write. Here the least that the language promises; a \
                           pass writes one."),
    ("gl_MinProgramTexelOffset", "The least offset, in texels, of `textureOffset` and its like."),
    ("gl_MaxProgramTexelOffset", "The greatest offset, in texels, of `textureOffset` and its like."),
    // Entry points.
    ("mainImage", "Called for each pixel: fragCoord is its centre in pixels from the bottom left, fragColor what it \
                   shall show. Alpha counts in buffers only."),
    ("mainCubemap", "Called for each texel of the six faces: a ray from the middle of the cube, rayOri, towards the \
                     texel, rayDir, of length 1."),
    ("mainSound", "Called for each sample: left and right, -1 to 1, at `time` seconds; samp is the number of the \
                   sample, 44100 a second."),
    // Macros of the header and of the language.
    ("HW_PERFORMANCE", "1 on a computer, 0 on a phone: for a cheaper version of what is costly. Here always 1."),
    ("GL_ES", "1: the language is GLSL ES."),
    ("__VERSION__", "300: the version of the language."),
    ("__LINE__", "Number of the line in the whole text the site's compiler sees, header and Common before this one."),
    ("__FILE__", "0, unless a `#line` has changed it."),
];

/// Members of `iCh0` to `iCh3`.
pub(super) const CHANNEL_MEMBERS: &[(&str, &str, &str)] = &[
    ("sampler", "sampler", "The texture, as `iChannelN`."),
    ("size", "vec3", "Its size in texels, as `iChannelResolution[N]`."),
    ("time", "float", "Seconds into its video or music, as `iChannelTime[N]`."),
    ("loaded", "int", "1 where the channel's media is there, else 0."),
];

/// Keywords that a newcomer may look up.
#[rustfmt::skip]
pub(super) const KEYWORDS: &[(&str, &str)] = &[
    ("const", "A value known before the shader runs; it must be given one. As a parameter: one the function does not \
               change."),
    ("in", "A parameter that is copied in; what the function does to it stays inside. What a parameter is without any \
            of in, out, inout."),
    ("out", "A parameter the function writes: copied to the argument when it returns. On entry it is zero here, \
             elsewhere undefined."),
    ("inout", "A parameter that is copied in and back out."),
    ("discard", "Leaves the pixel as it is and ends. In a buffer that is what it held two frames ago."),
    ("precision", "Default precision of a type. Here everything is 32 bits."),
    ("lowp", "Low precision will do. Here everything is 32 bits."),
    ("mediump", "Medium precision will do. Here everything is 32 bits."),
    ("highp", "Full precision. Here everything is 32 bits."),
    ("struct", "A type made of named members. Its name is its constructor too."),
    ("switch", "Goes to the `case` that equals an int or uint. Cases fall through into the next without `break`."),
    ("case", "A label of a `switch`: a constant int or uint."),
    ("default", "The label of a `switch` for every other value."),
    ("continue", "Goes on with the next round of the loop."),
    ("break", "Leaves the loop or switch."),
    ("return", "Leaves the function, with its value."),
    ("uniform", "A value the host sets. Nobody sets those a pass declares: they read as zero."),
    ("flat", "Not interpolated. Means nothing in a pass."),
    ("smooth", "Interpolated. Means nothing in a pass."),
    ("centroid", "Interpolated within the triangle. Means nothing in a pass."),
    ("invariant", "Computed alike in every program. Means nothing in a pass."),
    ("layout", "Where a value is stored. Means nothing in a pass."),
];

/// Directives of the preprocessor.
pub(super) const DIRECTIVES: &[(&str, &str)] = &[
    ("define", "Gives a name a text that stands for it: `#define NAME text`, or `#define NAME(a, b) text`."),
    ("undef", "Takes a macro's definition back."),
    ("if", "Compiles the lines up to `#endif` only if a constant condition holds."),
    ("ifdef", "Compiles the lines up to `#endif` only if a macro is defined."),
    ("ifndef", "Compiles the lines up to `#endif` only if a macro is not defined."),
    ("elif", "Else, if another condition holds."),
    ("else", "The lines for when no condition held."),
    ("endif", "Ends an `#if`."),
    ("error", "Stops the compile with this message."),
    ("pragma", "A hint to the compiler; none has an effect here."),
    ("line", "Changes what `__LINE__` says. Messages do not follow it."),
];
