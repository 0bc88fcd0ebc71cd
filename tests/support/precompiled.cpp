// Only there because a precompiled header needs a target (tests/CMakeLists.txt).
int main() {}
