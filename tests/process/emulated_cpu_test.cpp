// Runs the program on other processors in an emulator (qemu-user): without AVX, and without AVX-512. An
// unsupported instruction outside the dispatched kernels ends the program. The output must be the same.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "run_program.h"

#if defined(__x86_64__)

namespace edgewise::testing {
namespace {

struct Processor {
  const char* name;    // qemu's name
  const char* target;  // the expected best SIMD target
};

constexpr Processor kProcessors[] = {
    {"Nehalem", "scalar"},  // 2008: SSE4.2, but not the other extensions of Highway's SSE4
    {"Westmere", "sse4"},   // 2010
    {"Haswell", "avx2"},    // 2013
};

constexpr const char* kEmulator = "qemu-x86_64";

class EmulatedCpu : public ::testing::TestWithParam<Processor> {
 protected:
  void SetUp() override {
    if (std::system((std::string("command -v ") + kEmulator + " >/dev/null").c_str()) != 0)
      GTEST_SKIP() << kEmulator << " is not installed; on Debian: apt-get install qemu-user";
  }

  static Outcome emulate(const std::string& arguments) {
    return run_program(
        "env", std::string(kEmulator) + " -cpu " + GetParam().name + " '" EDGEWISE_PROGRAM "' " + arguments);
  }
};

TEST_P(EmulatedCpu, SelectsItsKernelsAndDrawsTheSameBits) {
  const Outcome list = emulate("machine");
  ASSERT_EQ(list.status, 0) << list.err;
  EXPECT_NE(list.out.find("\"simd_best\": \"" + std::string(GetParam().target) + '"'), std::string::npos)
      << list.out;
  const TempDir folder;
  const Outcome verify =
      emulate("verify torus-knot grid4 --size 70x67 --out '" + folder.path().string() + "/none'");
  EXPECT_EQ(verify.status, 0) << verify.out << verify.err;
}

TEST_P(EmulatedCpu, PrintsTheSameFactsAndPicturesAsThisMachine) {
  for (const char* arguments :
       {"accuracy drtk_quad bars_in_a_cycle edge_on in_view --json -", "stability cycle --quick --json -",
        "needs cubes --size 160x90 --json", "portable cubes --size 160x90 --json",
        "render torus-knot --size 120x90 -o - --format ppm", "render terrain --size 120x90 --depth -"}) {
    const Outcome here = run_program(EDGEWISE_PROGRAM, arguments), there = emulate(arguments);
    ASSERT_EQ(here.status, 0) << here.err;
    ASSERT_EQ(there.status, 0) << there.err;
    EXPECT_TRUE(here.out == there.out && !here.out.empty()) << arguments;
  }
}

INSTANTIATE_TEST_SUITE_P(Qemu, EmulatedCpu, ::testing::ValuesIn(kProcessors),
                         [](const auto& param) { return std::string(param.param.name); });

}  // namespace
}  // namespace edgewise::testing
#endif
