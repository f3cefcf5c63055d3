// mode: geekest300
// A text with a main of its own gets the declarations only.
vec3 shade(vec2 p){p*=rotate2D(t*3.);return vec3(.5+.4*p,.5);}
void main(){o=vec4(shade((FC.xy*2.-r)/r.x),1.);}
