#define K 0.3
