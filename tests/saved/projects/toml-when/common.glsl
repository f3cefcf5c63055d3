#iUniform int quality = 2 in { 0, 3 }
#iUniform bool detailed = false
