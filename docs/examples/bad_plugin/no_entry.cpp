// A shared library that is no plug-in: it exports something else.
extern "C" __attribute__((visibility("default"))) const int something_else;
const int something_else = 1;
