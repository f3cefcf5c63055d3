// mode: geekest300
vec2 p=FC.xy/r;for(float i=0.;i<4.;i++)o+=vec4(p.x,p.y*p.x,i/4.,1.)*.25;o.b+=t-.2*p.y;
