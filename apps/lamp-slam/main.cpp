#include "lamp/slam_app/SlamApp.h"

int main(int argc, char** argv) {
  return lamp::slamApp(argc, argv);
}
