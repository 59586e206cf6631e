#include "lamp/pose_graph/PgoApp.h"

int main(int argc, char** argv) {
  return lamp::pgoApp(argc, argv);
}
