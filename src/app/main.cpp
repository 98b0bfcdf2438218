#include "app/run.h"

int main(int argc, char** argv) {
  return edgewise::app::run(argc, argv);
}
