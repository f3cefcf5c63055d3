// mode: geeker300
// A target is cleared to opaque black: pixels that are discarded read alpha 1 in the next frame.
void main(){vec2 p=gl_FragCoord.xy/r;vec4 l=texture(b,p);if(p.x<.5&&mod(f,4.)>2.5)discard;o=vec4(l.a*.5,p.y,l.g*.5,.25);}
