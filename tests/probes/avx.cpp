// Exits normally only on processors with AVX.
int main() {
#if defined(__x86_64__)
  asm volatile("vpxor %%xmm0, %%xmm0, %%xmm0" ::: "xmm0");
#endif
}
