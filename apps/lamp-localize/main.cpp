#include "lamp/slam_app/LocalizeApp.h"

int main(int argc, char** argv) {
  return lamp::localizeApp(argc, argv);
}
