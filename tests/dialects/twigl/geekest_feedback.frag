// mode: geekest300
vec2 p=FC.xy/r;vec4 l=texture(b,p+vec2(.03125,0));o=f<1.5?vec4(p,0.,1.):vec4(l.rg*.9+.05,l.b+.1,1.);
