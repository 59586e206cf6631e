#include "lamp/simulation/SimApp.h"

int main(int argc, char** argv) {
  return lamp::simulation::simApp(argc, argv);
}
