// What the programs prepare before they begin; what they make of it is in invalid_inputs.h.
#include "support/process.h"

#include <gtest/gtest.h>

#include <new>
#include <stdexcept>
#include <thread>

namespace edgewise::app {
namespace {

template <typename Error>
void throw_on_a_thread(const Error& error) {
  prepare_process("edgewise");
  std::thread([&] { throw error; }).join();
}

// As oneTBB does where one of its threads cannot start another.
TEST(ProcessDeathTest, WhatNobodyCanCatchIsSaidInOneLine) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(throw_on_a_thread(std::runtime_error("pthread_create has failed: Resource unavailable")),
              ::testing::ExitedWithCode(2), "^edgewise: no more threads can be started; ask for fewer.*\n$");
  EXPECT_EXIT(throw_on_a_thread(std::bad_alloc()), ::testing::ExitedWithCode(2),
              "^edgewise: out of memory\n$");
}

}  // namespace
}  // namespace edgewise::app
