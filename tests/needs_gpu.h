#pragma once

#include <gtest/gtest.h>

#include "wheatstone/error.h"
#include "wheatstone/gpu/gpu.h"

namespace wheatstone {

/// Tests that are left out where there is neither a graphics processor nor one that the processor imitates.
class NeedsGpu : public testing::Test {
 protected:
  void SetUp() override {
    try {
      gpu_facts();
    } catch (const Error& error) {
      GTEST_SKIP() << error.what();
    }
  }
};

}  // namespace wheatstone
