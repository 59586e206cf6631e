#include "lamp/evaluation/EvalApp.h"

int main(int argc, char** argv) {
  return lamp::evaluation::evalApp(argc, argv);
}
