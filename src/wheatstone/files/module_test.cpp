#include "wheatstone/files/module.h"

#include <gtest/gtest.h>

#include <new>

#include "throws_error.h"

namespace wheatstone::module_test {

TEST(Module, ThatIsMissingIsNamed) {
  expect_error(ErrorKind::cannot_read_write, "a part of Wheatstone is not installed: libwheatstone_nothing.so",
               [] { function_of_module("wheatstone_nothing", "anything", 0); });
}

TEST(Module, ThatNeedsMoreThanThereIsIsNotLoaded) {
  constexpr std::size_t more_than_there_is = std::size_t{1} << 60;
  EXPECT_THROW(function_of_module("wheatstone_nothing", "anything", more_than_there_is), std::bad_alloc);
}

}  // namespace wheatstone::module_test
