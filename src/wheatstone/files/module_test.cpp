#include "wheatstone/files/module.h"

#include <gtest/gtest.h>

#include "throws_error.h"

namespace wheatstone {
namespace {

TEST(Module, ThatIsMissingIsNamed) {
  expect_error(ErrorKind::cannot_read_write, "a part of Wheatstone is not installed: libwheatstone_nothing.so",
               [] { function_of_module("wheatstone_nothing", "anything"); });
}

}  // namespace
}  // namespace wheatstone
