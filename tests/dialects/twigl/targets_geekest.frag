// mode: geekest300 mrt
vec2 p=FC.xy/r;vec4 l=texture(b1,p);o1=f<1.5?vec4(0.):l+vec4(p,.1,0.);o0=vec4(l.rgb*vec3(.15,.15,1.),1.);
