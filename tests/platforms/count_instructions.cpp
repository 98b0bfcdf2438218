// A plugin of QEMU's user mode (64-bit processors): before each write to standard output, it writes the
// number of instructions that the program executed since the last one. Only for programs with one thread:
// threads would count in the same number.
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>

extern "C" {

// From QEMU 7.2's qemu-plugin.h, version 1 of the interface; Debian 12 has no package of it.
extern const int qemu_plugin_version;
const int qemu_plugin_version = 1;
struct qemu_info_t;
struct qemu_plugin_tb;  // a block of instructions that are executed together
using Id = std::uint64_t;
using Word = std::uint64_t;
enum qemu_plugin_op { QEMU_PLUGIN_INLINE_ADD_U64 };
std::size_t qemu_plugin_tb_n_insns(const qemu_plugin_tb* block);
void qemu_plugin_register_vcpu_tb_trans_cb(Id id, void (*translated)(Id id, qemu_plugin_tb* block));
void qemu_plugin_register_vcpu_tb_exec_inline(qemu_plugin_tb* block, qemu_plugin_op op, void* to, Word add);
void qemu_plugin_register_vcpu_syscall_cb(Id id,
                                          void (*called)(Id id, unsigned cpu, std::int64_t number, Word, Word,
                                                         Word, Word, Word, Word, Word, Word));

int qemu_plugin_install(Id id, const qemu_info_t*, int, char**) {
  static Word executed = 0;
  qemu_plugin_register_vcpu_tb_trans_cb(id, [](Id, qemu_plugin_tb* block) {
    qemu_plugin_register_vcpu_tb_exec_inline(block, QEMU_PLUGIN_INLINE_ADD_U64, &executed,
                                             qemu_plugin_tb_n_insns(block));
  });
  qemu_plugin_register_vcpu_syscall_cb(id, [](Id, unsigned, std::int64_t number, Word file, auto...) {
    constexpr std::int64_t kWrite = 64;  // on aarch64 and riscv64
    if (number != kWrite || file != STDOUT_FILENO) return;
    dprintf(STDOUT_FILENO, "%llu ", static_cast<unsigned long long>(executed));
    executed = 0;
  });
  return 0;
}
}
