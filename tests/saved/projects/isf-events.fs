/*{ "ISFVSN": "2", "INPUTS": [ {"NAME": "flash", "TYPE": "event"}, {"NAME": "size", "TYPE": "float", "DEFAULT": 0.3} ] }*/
void main() { gl_FragColor = vec4(flash ? 1.0 : size, TIME, RENDERSIZE.x / 100.0, 1.0); }
