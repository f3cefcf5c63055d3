// mode: geeker
void main(){vec2 p=(gl_FragCoord.xy*2.-r)/min(r.x,r.y);gl_FragColor=vec4(.5+.25*p.x,f/16.,t*4.+.2*p.y*p.y+m.x+s,1.);}
