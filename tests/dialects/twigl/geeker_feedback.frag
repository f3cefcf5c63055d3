// mode: geeker
void main(){vec2 p=gl_FragCoord.xy/r;vec4 l=texture2D(b,p);gl_FragColor=vec4(f<1.5?vec2(0.):l.rg+.1*p,m.x+s+.5,1.);}
