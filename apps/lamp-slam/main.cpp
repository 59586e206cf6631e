#include "lamp/base_station/SlamApp.h"

int main(int argc, char** argv) { return lamp::slamApp(argc, argv); }
