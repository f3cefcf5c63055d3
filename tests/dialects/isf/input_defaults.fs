/*{
    "ISFVSN": "2",
    "DESCRIPTION": "What is missing in an input: a number is in the middle of its range, 0 to 1 if there is none, and a default is limited to the range.",
    "INPUTS": [
        {"NAME": "middle", "TYPE": "float", "MIN": 0.2, "MAX": 0.6},
        {"NAME": "half_way", "TYPE": "float"},
        {"NAME": "limited", "TYPE": "float", "DEFAULT": 3.0, "MIN": 0.0, "MAX": 0.75}
    ]
}*/
void main() {
    gl_FragColor = vec4(middle, half_way, limited, 1.0);
}
