// Process setup: uncaught exceptions. invalid_inputs.h tests signals, streams and limits.
#include "support/process.h"

#include <gtest/gtest.h>

#include <new>
#include <stdexcept>
#include <thread>

namespace edgewise::tools {
namespace {

template <typename Error>
void throw_on_a_thread(const Error& error) {
  prepare_process("edgewise");
  std::thread([&] { throw error; }).join();
}

// oneTBB throws like this if one of its threads cannot start another.
TEST(ProcessDeathTest, PrintsAnUncaughtExceptionInOneLine) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(throw_on_a_thread(std::runtime_error("pthread_create has failed: Resource unavailable")),
              ::testing::ExitedWithCode(2), "^edgewise: no more threads can be started; use fewer.*\n$");
  EXPECT_EXIT(throw_on_a_thread(std::bad_alloc()), ::testing::ExitedWithCode(2),
              "^edgewise: out of memory\n$");
}

}  // namespace
}  // namespace edgewise::tools
