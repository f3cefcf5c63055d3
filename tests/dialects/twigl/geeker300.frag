// mode: geeker300
float l(vec2 p){return length(p)-.5;}
void main(){vec2 p=(gl_FragCoord.xy*2.-r)/min(r.x,r.y);o=vec4(.6-.3*l(p),.5+.25*p.x,t*4.,1);}
