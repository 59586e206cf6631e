#include "lamp/slam_app/RegisterApp.h"

int main(int argc, char** argv) {
  return lamp::registerApp(argc, argv);
}
