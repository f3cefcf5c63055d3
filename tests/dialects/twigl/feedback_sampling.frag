// mode: geeker300
// The last frame is filtered, and its edges continue.
void main(){vec2 p=gl_FragCoord.xy/r;vec4 n=texture(b,p+vec2(.1171875,-.3));o=f<2.5?vec4(.5-.5*cos(p*6.2831853),p.x,1.):n;}
