// mode: geekest
vec2 p=(FC.xy*2.-r)/min(r.x,r.y);float c=0.;for(int i=0;i<5;i++){p*=rotate2D(t);c+=.1*abs(p.x);}gl_FragColor=vec4(c,.5+.2*p,1.);
