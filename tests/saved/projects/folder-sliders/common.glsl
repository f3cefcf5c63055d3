#iUniform float speed = 1.0 in { 0.0, 5.0 }
#iUniform float dent = 1.0 in { 0.0, 5.0 } step 0.2
#iUniform int rings = 5
#iUniform color3 tint = color3(1.0, 0.5, 0.0)
#iUniform vec4 gains = vec4(1.0) in { 0.0, 1.0 }
#iUniform bool wrapped = true
