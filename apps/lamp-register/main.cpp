#include "lamp/base_station/RegisterApp.h"

int main(int argc, char** argv) { return lamp::registerApp(argc, argv); }
