// mode: geeker300
// The last frame is of floats: beyond 0..1, and with steps below 1/255.
void main(){
    vec2 p=gl_FragCoord.xy/r;
    vec4 l=texture(b,p);
    if(f<1.5)l=vec4(0.);
    vec4 n=l+vec4(.0004,.35*p.x,-.2,.5);
    // The last frame of the test shows what has been kept.
    o=f<7.5?n:vec4(n.r*200.,n.g/4.,-n.b/2.,1.);
    if(p.y>.75&&f>7.5)o=vec4(vec3(n.a/8.),1.);
}
