#pragma once

class Good {
  void begin();
  void end();
};
