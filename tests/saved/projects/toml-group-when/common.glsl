#iUniform int turns = 3 in { 0, 9 }
