float radicalInverse(int i, int base) {
    float result = 0.0, digit = 1.0 / float(base);
    for (; i > 0; i /= base) {
        result += float(i % base) * digit;
        digit /= float(base);
    }
    return result;
}
