extern "C" float scaled(float value);
float scaled(float value) { return value * 1.5F; }
