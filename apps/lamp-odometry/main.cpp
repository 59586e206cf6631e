#include "lamp/slam_app/OdometryApp.h"

int main(int argc, char** argv) {
  return lamp::odometryApp(argc, argv);
}
