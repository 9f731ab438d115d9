// The laws against engines that obey them and engines that do not.
#include <gtest/gtest.h>
TEST(Laws, placeholder) {}
