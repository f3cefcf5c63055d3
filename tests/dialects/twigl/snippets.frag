// mode: geekest300
o=vec4(hsv(FC.x/r.x*.9,.75,.9),1);if(FC.y>6.)o.rgb=vec3(.5+.5*sin(FC.x/r.x*PI2),.5+.5*cos(FC.x/r.x*PI),FC.y/r.y);if(FC.y>12.)o.rg=.5+.3*vec2(1,.5)*rotate2D(FC.x/r.x);
