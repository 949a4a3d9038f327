#pragma once

#include <gmock/gmock.h>

#include <string>

#include "wheatstone/error.h"

namespace wheatstone {

/// Expects `call` to throw an Error of this kind whose one-line message holds `part`.
template <class Call>
void expect_error(ErrorKind kind, const std::string& part, Call call) {
  try {
    call();
    ADD_FAILURE() << "nothing thrown, expected an Error with: " << part;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kind) << error.what();
    EXPECT_THAT(error.what(), testing::HasSubstr(part));
    EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("\n")));
  }
}

}  // namespace wheatstone
