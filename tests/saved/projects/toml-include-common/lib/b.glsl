float b() { return 0.25; }
